// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace sconce {

/// The MTL files that an OBJ names.
std::vector<std::filesystem::path> mtl_files(const std::filesystem::path& obj);

/// The MTL files and textures that an OBJ names and that are there.
std::vector<std::filesystem::path> obj_files(const std::filesystem::path& obj);

}  // namespace sconce
