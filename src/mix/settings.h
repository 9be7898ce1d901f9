// SPDX-License-Identifier: Apache-2.0
// `GROUP=SETTING` text to weights. Grammar: architecture.md, "Settings"; formulas: contract.md, "Colour".
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "package/package.h"

namespace sconce {

/// One group's setting, parsed: off, on, GAIN, 50%, +1.5ev, 800lm, 2700K, color:#rrggbb, #rrggbb, joined by
/// commas.
struct GroupSetting {
  double gain = 1;               ///< product of gains and 2^ev; 0 for off
  std::optional<double> lumens;  ///< replaces the group's flux
  std::optional<double> kelvin;  ///< replaces the colour, keeps the flux
  std::optional<Rgb> color;      ///< linear; replaces the colour, keeps the flux
  Rgb tint{1.0f};                ///< linear; multiplies
};

/// @throws UsageError showing the text, and what is allowed
GroupSetting parse_setting(std::string_view text);

/// w_g of one group. `warn` gets at most one line: colour replaced where the group's lamps differ in colour.
/// @throws UsageError: lumens for sky or sun or where they are not known, two colours in one setting
Rgb group_weight(const GroupInfo& group, const GroupSetting& setting,
                 const std::function<void(const std::string&)>& warn);

/// The only thing a fader changes.
struct MixSpec {
  std::vector<Rgb> weights;  ///< per group of the manifest
};

/// Whether "GROUP=SETTING" addresses the group of that name. @throws UsageError where the text is none
bool names_group(std::span<const GroupInfo> groups, const std::string& assignment, std::string_view name);

/// `assignments` are "GROUP=SETTING", GROUP a name or glob, later ones win; `all` is every group; `others`
/// addresses every group not named. @throws UsageError: unknown group ("did you mean", and the list), bad
/// setting
MixSpec make_mix(std::span<const GroupInfo> groups, std::span<const std::string> assignments,
                 std::string_view others, const std::function<void(const std::string&)>& warn);

}  // namespace sconce
