// SPDX-License-Identifier: Apache-2.0
// Moods that lie beside a package.
#pragma once

#include <filesystem>

#include "mix/settings.h"

namespace sconce {

struct NearPreset {
  std::filesystem::path file;
  std::string name;  ///< the file's, without ending, and without the package's in front of it
};

/// Presets for these groups among the .toml files in the folder of `file` and in its folder `moods`, by name;
/// kMostNear at most. Files that are something else are left out.
std::vector<NearPreset> presets_near(const std::filesystem::path& file, std::span<const GroupInfo> groups);
inline constexpr std::size_t kMostNear = 24;

}  // namespace sconce
