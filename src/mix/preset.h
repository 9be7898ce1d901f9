// SPDX-License-Identifier: Apache-2.0
// A mood as a file:
//
//     exposure = "+1"        # optional: auto or stops
//     ev100 = "9"            # optional, instead of exposure: absolute, higher is darker
//     tone = "agx"           # optional
//     camera = "main"        # optional
//     others = "off"         # optional: every group that [mix] does not name
//     [mix]
//     ceiling = "0.5,2700K"  # GROUP = SETTING; globs in quotes: "lamp*" = 0.2
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sconce {

struct Preset {
  std::vector<std::string> assignments{};                       ///< "GROUP=SETTING" in the file's order
  std::string others{}, exposure{}, ev100{}, tone{}, camera{};  ///< empty = not given
};

/// `others` may also stand in [mix]. @throws UsageError naming file, line and key; Error when it cannot be
/// read
Preset read_preset(const std::filesystem::path& path);

/// A file's text that reads back as the same preset.
std::string print_preset(const Preset& preset);

}  // namespace sconce
