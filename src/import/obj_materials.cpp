// SPDX-License-Identifier: Apache-2.0
#include "import/obj_materials.h"

#include <assimp/material.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/picture.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr float kMissingTextureGrey = 0.5f;

Rgb color_of(const aiMaterial& m, const char* key, unsigned type, unsigned index, const Rgb& otherwise) {
  aiColor3D c;
  return m.Get(key, type, index, c) == AI_SUCCESS ? Rgb(c.r, c.g, c.b) : otherwise;
}

float number_of(const aiMaterial& m, const char* key, unsigned type, unsigned index, float otherwise) {
  float v = 0;
  return m.Get(key, type, index, v) == AI_SUCCESS ? v : otherwise;
}

std::string texture_name(const aiMaterial& m, aiTextureType type) {
  aiString name;
  return m.GetTexture(type, 0, &name) == AI_SUCCESS ? name.C_Str() : "";
}

/// MTL files come from all kinds of systems.
fs::path beside(const fs::path& obj, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return obj.parent_path() / name;
}

bool is_file(const fs::path& path) {
  std::error_code ec;
  return fs::is_regular_file(path, ec);
}

/// What follows `keyword` on the lines that begin with it.
std::vector<std::string> statements(const fs::path& file, std::string_view keyword) {
  std::vector<std::string> out;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    line = trim(line);
    if (line.size() > keyword.size() && lower(line.substr(0, keyword.size())) == keyword &&
        std::isspace(static_cast<unsigned char>(line[keyword.size()])))
      out.push_back(trim(line.substr(keyword.size())));
  }
  return out;
}

}  // namespace

Id<Texture> ObjMaterials::texture(const std::string& name) {
  if (const auto found = known_.find(name); found != known_.end()) return found->second;
  Id<Texture> id;
  try {
    const std::string bytes = read_file(beside(obj_, name));
    Texture out;
    out.name = name;
    out.file.assign(bytes.begin(), bytes.end());
    out.pixels = decode_texture(out.file, name);
    out.mime = picture_mime(out.file);
    if (out.mime.empty()) out.file.clear();
    id = Id<Texture>(scene_.textures.size());
    scene_.textures.push_back(std::move(out));
  } catch (const Error& e) {
    progress_.warn(obj_.string() + ": texture " + name + " is left out: " + e.what());
  }
  return known_[name] = id;
}

void ObjMaterials::add(const aiMaterial& m) {
  Material out;
  aiString name;
  if (m.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) out.name = name.C_Str();
  out.base_color = color_of(m, AI_MATKEY_COLOR_DIFFUSE, Rgb(0.8f));
  out.emission = color_of(m, AI_MATKEY_COLOR_EMISSIVE, Rgb(0));
  out.alpha = number_of(m, AI_MATKEY_OPACITY, 1);
  if (out.alpha < 1) {
    out.alpha_mode = Material::Alpha::blend;
    progress_.warn(obj_.string() + ": material '" + out.name + "' is transparent; it is treated as opaque");
  }
  const auto slot = [&](aiTextureType type, TextureUse& use) {
    const std::string file = texture_name(m, type);
    if (file.empty()) return true;
    use.texture = texture(file);
    aiTextureMapMode mode = aiTextureMapMode_Wrap;
    if (use.texture && m.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode) == AI_SUCCESS &&
        mode == aiTextureMapMode_Clamp)
      scene_.textures[use.texture.value].wrap_u = scene_.textures[use.texture.value].wrap_v =
          Texture::Wrap::clamp;
    return use.texture.valid();
  };
  if (!texture_name(m, aiTextureType_DIFFUSE).empty()) {
    // Exporters write Kd 0 beside a map that is meant to be seen.
    if (out.base_color.is_black()) out.base_color = Rgb(1);
    if (!slot(aiTextureType_DIFFUSE, out.base_color_texture)) out.base_color *= kMissingTextureGrey;
  }
  if (out.emits()) slot(aiTextureType_EMISSIVE, out.emission_texture);
  if (!texture_name(m, aiTextureType_OPACITY).empty())
    progress_.warn(obj_.string() + ": material '" + out.name +
                   "': map_d is ignored; it is treated as opaque");
  // Winding in OBJ files is a matter of luck; lamps keep their front, so that their flux is what Ke says.
  out.double_sided = !out.emits();
  scene_.materials.push_back(std::move(out));
}

std::vector<fs::path> mtl_files(const fs::path& obj) {
  std::vector<fs::path> out;
  for (const std::string& name : statements(obj, "mtllib")) out.push_back(beside(obj, name));
  return out;
}

std::vector<fs::path> obj_files(const fs::path& obj) {
  std::set<fs::path> out;
  for (const fs::path& mtl : mtl_files(obj)) {
    if (!is_file(mtl)) continue;
    out.insert(mtl);
    for (const char* key : {"map_kd", "map_ke"})
      for (const std::string& value : statements(mtl, key)) {
        // Options stand before the name, which may hold spaces: the longest tail that is a file.
        for (std::size_t at = 0; at != std::string::npos; at = value.find(' ', at + 1)) {
          const fs::path file = beside(obj, trim(value.substr(at)));
          if (!is_file(file)) continue;
          out.insert(file);
          break;
        }
      }
  }
  return {out.begin(), out.end()};
}

}  // namespace sconce
