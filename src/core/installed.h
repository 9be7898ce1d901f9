// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace sconce {

/// A file that comes with the program: beside it, as in a build folder, or in ../share/sconce, as installed.
/// @param name  e.g. "web/index.html"
/// @return where it is, or would be in a build folder
std::filesystem::path installed_file(const std::filesystem::path& name);

}  // namespace sconce
