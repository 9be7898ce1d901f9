// SPDX-License-Identifier: Apache-2.0
// MTL: Kd, map_Kd, Ke, map_Ke, d, Tr, map_d (Wavefront, Advanced Visualizer, appendix B1).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/plain_materials.h"

namespace sconce {

/// The materials of an MTL text in its order. A property before the first name, of another kind or with
/// damaged numbers is left out.
std::vector<PlainMaterial> parse_mtl(std::string text);

/// The MTL files that an OBJ names, whether they are there or not. @throws Error
std::vector<std::filesystem::path> mtl_files(const std::filesystem::path& obj);

/// The MTL files and textures that an OBJ names and that are there. @throws NotMyFormat, Error
std::vector<std::filesystem::path> obj_files(const std::filesystem::path& obj);

}  // namespace sconce
