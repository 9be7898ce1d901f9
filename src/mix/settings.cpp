// SPDX-License-Identifier: Apache-2.0
#include "mix/settings.h"

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/kelvin.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr const char* kAllowed =
    "off, on, 0.5, 50%, +1.5ev, 800lm, 2700K, color:#rrggbb, #rrggbb, joined by commas";

// A lamp's colour that rounding alone moved off the group's mean is still that colour.
constexpr double kSameColor = 1e-4;

std::optional<Rgb> parse_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  unsigned code = 0;
  const auto [end, ec] = std::from_chars(text.data() + 1, text.data() + 7, code, 16);
  if (ec != std::errc() || end != text.data() + 7) return std::nullopt;
  const auto channel = [&](unsigned shift) {
    return srgb_to_linear(static_cast<float>((code >> shift) & 255u) / 255.0f);
  };
  return Rgb(channel(16), channel(8), channel(0));
}

/// The number before `unit`, when the term ends with it.
std::optional<double> number_before(std::string_view term, std::string_view unit) {
  if (!term.ends_with(unit)) return std::nullopt;
  return parse_number(term.substr(0, term.size() - unit.size()));
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  GroupSetting run() {
    for (const std::string& part : split(text_, ',')) term(lower(trim(part)));
    if (!std::isfinite(setting_.gain)) fail("is too strong");
    return setting_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw UsageError({}, "setting '" + std::string(text_) + "' " + what, kAllowed);
  }

  void one_color() {
    if (colored_) fail("has two colours");
    colored_ = true;
  }

  void gain(double factor) {
    if (factor < 0) fail("is negative");
    setting_.gain *= factor;
  }

  void term(const std::string& t) {
    if (t == "off") return gain(0);
    if (t == "on") return;
    if (const auto ev = number_before(t, "ev")) return gain(std::exp2(*ev));
    if (const auto percent = number_before(t, "%")) return gain(*percent / 100);
    if (const auto plain = number_before(t, "")) return gain(*plain);
    if (const auto lumens = number_before(t, "lm")) {
      if (setting_.lumens) fail("has two fluxes");
      if (*lumens < 0) fail("is negative");
      setting_.lumens = lumens;
      return;
    }
    if (const auto kelvin = number_before(t, "k")) {
      one_color();
      if (!(*kelvin >= kKelvinMin && *kelvin <= kKelvinMax)) fail("is outside 1000K to 11000K");
      setting_.kelvin = kelvin;
      return;
    }
    const bool replace = t.starts_with("color:");
    const std::optional<Rgb> color = parse_hex(replace ? std::string_view(t).substr(6) : std::string_view(t));
    if (!color) fail("is not understood");
    one_color();
    if (!replace) {
      setting_.tint = *color;
      return;
    }
    if (color->is_black()) fail("has no colour to give: black");
    setting_.color = color;
  }

  std::string_view text_;
  GroupSetting setting_;
  bool colored_ = false;
};

void warn_of_colors(const GroupInfo& group, const std::function<void(const std::string&)>& warn) {
  if (!warn) return;
  const std::string name = "group '" + group.name + "': ";
  if (group.color_spread < 0) {
    warn(name + "the colour of its lamps is not known; taken as white");
  } else if (group.color_spread > kSameColor) {
    warn(name + "its lamps differ in colour; the new colour is exact for their mean only");
  } else if (std::min({group.color.r, group.color.g, group.color.b}) <= 0) {
    warn(name + "its light lacks a primary colour, which no setting brings back");
  }
}

}  // namespace

GroupSetting parse_setting(std::string_view text) {
  return Parser(text).run();
}

Rgb group_weight(const GroupInfo& group, const GroupSetting& setting,
                 const std::function<void(const std::string&)>& warn) {
  double gain = setting.gain;
  if (setting.lumens) {
    if (group.infinite)
      throw UsageError("group '" + group.name + "'", "shines from infinity and has no lumens", "GAIN, +1ev");
    if (!(group.lumens > 0))
      throw UsageError("group '" + group.name + "'", "its lumens are not known", "GAIN, +1ev");
    gain *= *setting.lumens / group.lumens;
  }
  if ((setting.kelvin ? 1 : 0) + (setting.color ? 1 : 0) + (setting.tint == Rgb(1) ? 0 : 1) > 1)
    throw UsageError("group '" + group.name + "'", "two colours in one setting");
  const auto strength = static_cast<float>(gain);
  if (!setting.kelvin && !setting.color) return setting.tint * strength;

  const Rgb target =
      setting.kelvin ? kelvin_color(*setting.kelvin) : *setting.color / luminance(*setting.color);
  warn_of_colors(group, warn);
  const auto ratio = [](float wanted, float own) { return own > 0 ? wanted / own : 0.0f; };
  return strength *
         Rgb(ratio(target.r, group.color.r), ratio(target.g, group.color.g), ratio(target.b, group.color.b));
}

}  // namespace sconce
