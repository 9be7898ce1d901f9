// SPDX-License-Identifier: Apache-2.0
#include "session/presets_near.h"

#include <algorithm>

#include "core/error.h"
#include "session/fader.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

bool fits(const fs::path& file, std::span<const GroupInfo> groups) {
  try {
    const Preset preset = read_preset(file);
    if (preset.assignments.empty() && preset.others.empty()) return false;
    to_faders(groups, preset);
    return true;
  } catch (const Error&) {
    return false;  // a side file, or another scene's
  }
}

}  // namespace

std::vector<NearPreset> presets_near(const fs::path& file, std::span<const GroupInfo> groups) {
  const fs::path folder = fs::absolute(file).parent_path();
  const std::string stem = file.stem().string() + "-";
  std::vector<fs::path> files;
  for (const fs::path& where : {folder, folder / "moods"}) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(where, failed))
      if (entry.path().extension() == ".toml" && entry.is_regular_file(failed)) files.push_back(entry.path());
  }
  std::vector<NearPreset> found;
  for (const fs::path& path : files)
    if (found.size() < kMostNear && fits(path, groups)) {
      const std::string name = path.stem().string();
      found.push_back({path, name.starts_with(stem) ? name.substr(stem.size()) : name});
    }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return found;
}

}  // namespace sconce
