// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/plain_materials.h"

struct aiMaterial;
struct aiScene;

namespace sconce {

/// Diffuse and emissive colour and map, opacity and its map.
PlainMaterial plain_material(const aiMaterial& material);

/// The picture that a material names: embedded in the scene, or a file beside it. @throws Error
std::vector<unsigned char> assimp_picture(const std::filesystem::path& file, const aiScene& read,
                                          const std::string& name);

/// Files of the textures that the materials name and that are there.
std::vector<std::filesystem::path> texture_files(const std::filesystem::path& file, const aiScene& read);

/// Textures that a file of import_assimp()'s formats names and that are there. @throws NotMyFormat, Error
std::vector<std::filesystem::path> assimp_files(const std::filesystem::path& file);

}  // namespace sconce
