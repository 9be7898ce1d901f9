// SPDX-License-Identifier: Apache-2.0
// What a window keeps between two runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sconce {

struct Remembered {
  int width = 1440, height = 860;
  float panel = 380;                ///< width of the faders' side
  std::vector<std::string> recent;  ///< files, the last one first

  void opened(const std::filesystem::path& file);
  static constexpr std::size_t kMostRecent = 10;
};

/// $XDG_STATE_HOME/sconce/view.json, by default below ~/.local/state. Empty where there is no home.
std::filesystem::path remembered_file();
/// What the file holds; the defaults where it is missing or damaged: it is of no importance.
Remembered remember(const std::filesystem::path& file);
/// Makes the folder; a failure is none.
void keep(const Remembered& remembered, const std::filesystem::path& file);

}  // namespace sconce
