// SPDX-License-Identifier: Apache-2.0
#include "import/assimp_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <set>

#include "core/error.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

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

PlainMaterial::Map map_of(const aiMaterial& m, aiTextureType type) {
  aiTextureMapMode mode = aiTextureMapMode_Wrap;
  m.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode);
  return {texture_name(m, type), mode == aiTextureMapMode_Clamp};
}

}  // namespace

std::vector<unsigned char> assimp_picture(const fs::path& file, const aiScene& read,
                                          const std::string& name) {
  const aiTexture* embedded = read.GetEmbeddedTexture(name.c_str());
  if (embedded == nullptr) return picture_beside(file, name);
  if (embedded->mHeight != 0) throw Error(name, "is embedded without compression", "PNG or JPEG");
  const auto* bytes = reinterpret_cast<const unsigned char*>(embedded->pcData);
  return {bytes, bytes + embedded->mWidth};
}

PlainMaterial plain_material(const aiMaterial& m) {
  PlainMaterial out;
  aiString name;
  if (m.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) out.name = name.C_Str();
  out.diffuse = color_of(m, AI_MATKEY_COLOR_DIFFUSE, out.diffuse);
  out.emissive = color_of(m, AI_MATKEY_COLOR_EMISSIVE, out.emissive);
  out.opacity = number_of(m, AI_MATKEY_OPACITY, out.opacity);
  out.diffuse_map = map_of(m, aiTextureType_DIFFUSE);
  out.emissive_map = map_of(m, aiTextureType_EMISSIVE);
  out.opacity_map = map_of(m, aiTextureType_OPACITY);
  return out;
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
