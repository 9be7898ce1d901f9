// SPDX-License-Identifier: Apache-2.0
#include "import/assimp_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/picture.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr float kMissingTextureGrey = 0.5f;
constexpr unsigned char kNothing = 16;  // opacity codes so near to 0 or 255 are meant so

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

/// Of a file, or of what is embedded in the scene's. @throws Error
std::vector<unsigned char> bytes_of(const fs::path& file, const aiScene& read, const std::string& name) {
  if (const aiTexture* embedded = read.GetEmbeddedTexture(name.c_str())) {
    if (embedded->mHeight != 0) throw Error(name, "is embedded without compression", "PNG or JPEG");
    const auto* bytes = reinterpret_cast<const unsigned char*>(embedded->pcData);
    return {bytes, bytes + embedded->mWidth};
  }
  const std::string bytes = read_file(find_beside(file, name));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

fs::path find_beside(const fs::path& scene, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path given = scene.parent_path() / name;
  if (is_file(given)) return given;
  std::error_code ec;
  const std::string last = lower(given.filename().string());
  for (const fs::directory_entry& entry :
       fs::directory_iterator(scene.has_parent_path() ? scene.parent_path() : ".", ec))
    if (lower(entry.path().filename().string()) == last && is_file(entry.path())) return entry.path();
  return given;
}

Id<Texture> AssimpMaterials::texture(const std::string& name) {
  if (const auto found = known_.find(name); found != known_.end()) return found->second;
  Id<Texture> id;
  try {
    Texture out;
    out.name = name;
    out.file = bytes_of(file_, read_, name);
    out.pixels = decode_texture(out.file, name);
    out.mime = picture_mime(out.file);
    if (out.mime.empty()) out.file.clear();
    id = Id<Texture>(scene_.textures.size());
    scene_.textures.push_back(std::move(out));
  } catch (const Error& e) {
    progress_.warn(file_.string() + ": texture " + name + " is left out: " + e.what());
  }
  return known_[name] = id;
}

Id<Texture> AssimpMaterials::cut_out(Id<Texture> color, const Texture& opacity, bool& halves) {
  Texture out = color ? scene_[color] : opacity;
  out.name += color ? " cut out by " + opacity.name : "";
  out.file.clear(), out.mime.clear();
  const Image8 &mask = opacity.pixels, *seen = color ? &scene_[color].pixels : nullptr;
  const bool by_alpha = mask.channels == 4 &&
                        std::any_of(mask.data.begin(), mask.data.end(),
                                    [&, i = 0](unsigned char v) mutable { return i++ % 4 == 3 && v < 255; });
  Image8& pixels = out.pixels;
  pixels = {
      std::max(mask.width, seen ? seen->width : 0), std::max(mask.height, seen ? seen->height : 0), 4, {}};
  // The texel of `image` at the place of (x, y).
  const auto at = [&](const Image8& image, int x, int y) {
    const int u = x * image.width / pixels.width, v = y * image.height / pixels.height;
    return &image.data[static_cast<std::size_t>((v * image.width + u) * image.channels)];
  };
  std::size_t between = 0;
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const unsigned char alpha = at(mask, x, y)[by_alpha ? 3 : 0];
      for (int c = 0; c < 3; ++c)
        pixels.data.push_back(seen != nullptr ? at(*seen, x, y)[c] : static_cast<unsigned char>(255));
      pixels.data.push_back(alpha);
      between += alpha > kNothing && alpha < 255 - kNothing ? 1 : 0;
    }
  halves = between > pixels.data.size() / 4 / 10;
  scene_.textures.push_back(std::move(out));
  return Id<Texture>(scene_.textures.size() - 1);
}

void AssimpMaterials::add(const aiMaterial& m) {
  Material out;
  aiString name;
  if (m.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) out.name = name.C_Str();
  out.base_color = color_of(m, AI_MATKEY_COLOR_DIFFUSE, Rgb(0.8f));
  out.emission = color_of(m, AI_MATKEY_COLOR_EMISSIVE, Rgb(0));
  out.alpha = number_of(m, AI_MATKEY_OPACITY, 1);
  if (out.alpha < 1) out.alpha_mode = Material::Alpha::blend;
  if (out.alpha <= 0) {  // mostly a share of transparency taken for one of opacity
    out.alpha = 1, out.alpha_mode = Material::Alpha::opaque;
    progress_.warn(file_.string() + ": material '" + out.name +
                   "' would be invisible; it is treated as opaque");
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
  TextureUse opacity;
  if (!out.emits() && slot(aiTextureType_OPACITY, opacity) && opacity.texture) {
    bool halves = false;
    out.base_color_texture.texture =
        cut_out(out.base_color_texture.texture, Texture(scene_[opacity.texture]), halves);
    out.alpha_mode = halves || out.alpha < 1 ? Material::Alpha::blend : Material::Alpha::mask;
  }
  // Winding in such files is a matter of luck; lamps keep their front, so that their flux is what Ke says.
  out.double_sided = !out.emits();
  scene_.materials.push_back(std::move(out));
}

void AssimpMaterials::drop_unused_textures() {
  std::vector<Id<Texture>> moved(scene_.textures.size());
  std::vector<Texture> kept;
  for (Material& m : scene_.materials)
    for (TextureUse* use : {&m.base_color_texture, &m.emission_texture}) {
      if (!use->texture) continue;
      Id<Texture>& to = moved[use->texture.value];
      if (!to) {
        to = Id<Texture>(kept.size());
        kept.push_back(std::move(scene_.textures[use->texture.value]));
      }
      use->texture = to;
    }
  scene_.textures = std::move(kept);
  known_.clear();
}

std::vector<fs::path> texture_files(const fs::path& file, const aiScene& read) {
  std::set<fs::path> out;
  for (unsigned i = 0; i < read.mNumMaterials; ++i)
    for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_EMISSIVE, aiTextureType_OPACITY}) {
      const std::string name = texture_name(*read.mMaterials[i], type);
      if (name.empty() || read.GetEmbeddedTexture(name.c_str()) != nullptr) continue;
      if (const fs::path found = find_beside(file, name); is_file(found)) out.insert(found);
    }
  return {out.begin(), out.end()};
}

}  // namespace sconce
