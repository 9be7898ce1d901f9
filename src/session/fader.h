// SPDX-License-Identifier: Apache-2.0
// What a person moves: one fader per light group, a master, and their way to weights, to `GROUP=SETTING` text
// and to presets.
#pragma once

#include "mix/preset.h"
#include "mix/settings.h"

namespace sconce {

struct Fader {
  bool on = true;
  bool solo = false, mute = false;  ///< for listening, not part of a preset
  double gain = 1;
  enum class Color : uint8_t { own, kelvin, color, tint } color = Color::own;
  double kelvin = 2700;
  Rgb code{1.0f};  ///< sRGB in [0,1], of `color` and `tint`

  bool operator==(const Fader&) const = default;
};

/// Fader positions in stops end here; below is off.
inline constexpr double kLowestStop = -10, kHighestStop = 6;
/// log2 of a gain, within the fader's ends. @return kLowestStop for 0
double stops_of(double gain);
/// @return 0 at kLowestStop
double gain_of(double stops);

struct Faders {
  std::vector<Fader> groups;
  double master = 1;

  bool operator==(const Faders&) const = default;
};

/// `off`, `0.5,2700K`, `on`: as make_mix() reads it. Solo and mute are left out.
/// @param factor  on the gain
std::string setting_text(const Fader& fader, double factor = 1);
/// `current` with what a setting says; the rest stays. @throws UsageError
Fader with_setting(const Fader& current, const GroupInfo& group, std::string_view text);

/// Weights as they are to be shown: where some fader is solo, only those shine.
/// @param warn  as of group_weight()
MixSpec make_mix(std::span<const GroupInfo> groups, const Faders& faders,
                 const std::function<void(const std::string&)>& warn = {});

/// Settings of all groups, the master multiplied in; exposure, tone and camera are the caller's.
Preset to_preset(std::span<const GroupInfo> groups, const Faders& faders);
/// @throws UsageError as make_mix(): unknown group, bad setting
Faders to_faders(std::span<const GroupInfo> groups, const Preset& preset);

/// Between two mixes, t in [0,1]: light itself is faded, so that every moment is a sum of both.
MixSpec cross_fade(const MixSpec& from, const MixSpec& to, double t);

}  // namespace sconce
