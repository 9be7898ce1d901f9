// SPDX-License-Identifier: Apache-2.0
#include "session/fader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sconce {

namespace {

std::string hex(const Rgb& code) {
  const auto byte = [](float v) { return static_cast<int>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(code.r), byte(code.g), byte(code.b));
}

Rgb to_codes(const Rgb& linear) {
  return {linear_to_srgb(linear.r), linear_to_srgb(linear.g), linear_to_srgb(linear.b)};
}

}  // namespace

double stops_of(double gain) {
  return gain > 0 ? std::clamp(std::log2(gain), kLowestStop, kHighestStop) : kLowestStop;
}

double gain_of(double stops) {
  return stops <= kLowestStop ? 0 : std::exp2(std::min(stops, kHighestStop));
}

std::string setting_text(const Fader& fader, double factor) {
  const double gain = fader.gain * factor;
  if (!fader.on || gain <= 0) return "off";
  std::string text = gain == 1 ? "on" : fmt::format("{:.6g}", gain);
  if (fader.color == Fader::Color::kelvin) text += fmt::format(",{:.0f}K", fader.kelvin);
  if (fader.color == Fader::Color::color) text += ",color:" + hex(fader.code);
  if (fader.color == Fader::Color::tint) text += "," + hex(fader.code);
  return text;
}

Fader with_setting(const Fader& current, const GroupInfo& group, std::string_view text) {
  const GroupSetting setting = parse_setting(text);
  // Lumens, and what they cannot be given to.
  GroupSetting strength;
  strength.gain = setting.gain, strength.lumens = setting.lumens;
  const double gain = static_cast<double>(group_weight(group, strength, {}).r);
  Fader fader = current;
  fader.on = gain > 0;
  if (fader.on) fader.gain = gain;
  fader.color = Fader::Color::own;
  if (setting.kelvin) fader.color = Fader::Color::kelvin, fader.kelvin = *setting.kelvin;
  if (setting.color) fader.color = Fader::Color::color, fader.code = to_codes(*setting.color);
  if (!(setting.tint == Rgb(1))) fader.color = Fader::Color::tint, fader.code = to_codes(setting.tint);
  return fader;
}

MixSpec make_mix(std::span<const GroupInfo> groups, const Faders& faders,
                 const std::function<void(const std::string&)>& warn) {
  const bool solo =
      std::any_of(faders.groups.begin(), faders.groups.end(), [](const Fader& f) { return f.solo; });
  MixSpec mix;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Fader& fader = faders.groups.at(g);
    GroupSetting setting;
    setting.gain = fader.on && !fader.mute && (!solo || fader.solo) ? fader.gain * faders.master : 0;
    const auto channel = [](float code) { return srgb_to_linear(std::clamp(code, 0.0f, 1.0f)); };
    const Rgb linear(channel(fader.code.r), channel(fader.code.g), channel(fader.code.b));
    if (fader.color == Fader::Color::kelvin) setting.kelvin = fader.kelvin;
    if (fader.color == Fader::Color::color && !linear.is_black()) setting.color = linear;
    if (fader.color == Fader::Color::tint) setting.tint = linear;
    mix.weights.push_back(group_weight(groups[g], setting, warn));
  }
  return mix;
}

Preset to_preset(std::span<const GroupInfo> groups, const Faders& faders) {
  Preset preset;
  for (std::size_t g = 0; g < groups.size(); ++g)
    preset.assignments.push_back(groups[g].name + "=" + setting_text(faders.groups.at(g), faders.master));
  return preset;
}

Faders to_faders(std::span<const GroupInfo> groups, const Preset& preset) {
  make_mix(groups, preset.assignments, preset.others, {});  // finds what is wrong with it
  Faders faders;
  for (const GroupInfo& group : groups) {
    // Which of the assignments is this group's: the last one that touches it.
    std::string_view text = preset.others;
    for (const std::string& assignment : preset.assignments)
      if (names_group(groups, assignment, group.name))
        text = std::string_view(assignment).substr(assignment.rfind('=') + 1);
    faders.groups.push_back(text.empty() ? Fader{} : with_setting({}, group, text));
  }
  return faders;
}

MixSpec cross_fade(const MixSpec& from, const MixSpec& to, double t) {
  const auto share = static_cast<float>(std::clamp(t, 0.0, 1.0));
  MixSpec mix;
  for (std::size_t g = 0; g < to.weights.size(); ++g)
    mix.weights.push_back((1 - share) * from.weights.at(g) + share * to.weights[g]);
  return mix;
}

}  // namespace sconce
