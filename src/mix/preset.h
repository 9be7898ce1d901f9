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
//     [lamp.pendant]         # of a package with an operator: one that moves, or becomes another
//     at = [1, 1.9, 0.5]     # optional, metres
//     target = [1, 0, 0.5]   # optional: that it points to
//     kind = "spot,outer=40" # optional, in the words of `sconce relight --kind`
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"

namespace sconce {

struct PresetLamp {
  std::string name;
  std::optional<Vec3> at{}, target{};
  std::string kind{};  ///< empty = its own
};

struct Preset {
  std::vector<std::string> assignments{};                       ///< "GROUP=SETTING" in the file's order
  std::string others{}, exposure{}, ev100{}, tone{}, camera{};  ///< empty = not given
  std::vector<PresetLamp> lamps{};
};

/// `others` may also stand in [mix]. @throws UsageError naming file, line and key; Error when it cannot be
/// read
Preset read_preset(const std::filesystem::path& path);

/// A file's text that reads back as the same preset.
std::string print_preset(const Preset& preset);

}  // namespace sconce
