// SPDX-License-Identifier: Apache-2.0
#include "tone/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace sconce {

namespace {

struct Stop {
  float place;
  Rgb code;
};
// Lightness grows up to yellow, so that the scale reads in grey, too.
constexpr std::array<Stop, 8> kStops{{{0.00f, {0.04f, 0.04f, 0.14f}},
                                      {0.15f, {0.12f, 0.18f, 0.55f}},
                                      {0.32f, {0.08f, 0.45f, 0.75f}},
                                      {0.48f, {0.10f, 0.66f, 0.55f}},
                                      {0.62f, {0.48f, 0.80f, 0.25f}},
                                      {0.76f, {0.98f, 0.88f, 0.20f}},
                                      {0.89f, {0.96f, 0.48f, 0.12f}},
                                      {1.00f, {0.80f, 0.07f, 0.14f}}}};
constexpr std::size_t kMostTicks = 16;
constexpr std::array<double, 3> kRound{1, 2, 5};

/// How many ticks lie at or below the value.
std::size_t band(const std::vector<float>& ticks, float value) {
  return static_cast<std::size_t>(std::upper_bound(ticks.begin(), ticks.end(), value) - ticks.begin());
}

/// Where values leap, an edge of something lies between, and no line.
bool line_between(const std::vector<float>& ticks, float a, float b) {
  constexpr float kLeap = 0.15f;
  return std::abs(a - b) <= kLeap * std::max(a, b) && band(ticks, a) != band(ticks, b);
}

}  // namespace

void FalseColor::check() const {
  if (!(high > low) || !std::isfinite(high) || !(low >= 0) || (decades && !(low > 0)))
    throw UsageError({}, fmt::format("a false-colour scale cannot run from {:g} to {:g}", low, high),
                     decades ? "0 < low < high" : "0 <= low < high");
}

float FalseColor::place(float value) const {
  const float v = value > low ? value : low;
  const float at = decades ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  return std::min(at, 1.0f);
}

std::vector<float> legend_ticks(const FalseColor& scale) {
  const double low = static_cast<double>(scale.low), high = static_cast<double>(scale.high);
  std::vector<float> ticks;
  const auto add = [&](double value) {
    if (value >= low * (1 - 1e-6) && value <= high * (1 + 1e-6)) ticks.push_back(static_cast<float>(value));
  };
  if (scale.decades) {
    const int first = static_cast<int>(std::floor(std::log10(low))),
              last = static_cast<int>(std::ceil(std::log10(high)));
    const bool all = last - first <= 5;
    for (int decade = first; decade <= last; ++decade)
      for (const double round : kRound)
        if (all || round == 1) add(round * std::pow(10.0, decade));
  } else {
    double step = std::pow(10.0, std::floor(std::log10((high - low) / 4)));
    for (const double round : {5.0, 2.0, 1.0})
      if ((high - low) / (round * step) >= 4) {
        step *= round;
        break;
      }
    for (double i = std::max(0.0, std::ceil(low / step - 1e-6)); i * step <= high * (1 + 1e-6); ++i)
      add(i * step);
  }
  ticks.resize(std::min(ticks.size(), kMostTicks));
  return ticks;
}

std::string tick_text(float value) {
  if (value < 1000) return fmt::format("{:g}", value);
  std::string digits = fmt::format("{:.0f}", value);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

Rgb false_color(float place) {
  std::size_t i = 1;
  while (i + 1 < kStops.size() && place > kStops[i].place) ++i;
  const Stop &a = kStops[i - 1], &b = kStops[i];
  const float t = std::clamp((place - a.place) / (b.place - a.place), 0.0f, 1.0f);
  return (1 - t) * a.code + t * b.code;
}

Image8 false_color(const Image& values, const FalseColor& scale) {
  scale.check();
  const std::vector<float> ticks = legend_ticks(scale);
  const auto value = [&](int x, int y) {
    return values.stride() < 3 ? *values.at(x, y) : luminance(values.rgb_at(x, y));
  };
  Image8 out{values.width, values.height, 3, std::vector<unsigned char>(3 * values.pixels())};
  parallel_for(static_cast<std::size_t>(values.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    unsigned char* to = &out.data[3 * row * static_cast<std::size_t>(values.width)];
    for (int x = 0; x < values.width; ++x) {
      const float v = value(x, y);
      Rgb code = false_color(scale.place(v));
      const int right = std::min(x + 1, values.width - 1), below = std::min(y + 1, values.height - 1);
      if (scale.lines && (line_between(ticks, v, value(right, y)) || line_between(ticks, v, value(x, below))))
        code = code * 0.25f;
      for (const float c : {code.r, code.g, code.b}) *to++ = static_cast<unsigned char>(c * 255.0f + 0.5f);
    }
  });
  return out;
}

std::string false_color_glsl() {
  const auto vec3 = [](const Rgb& c) { return fmt::format("vec3({:f}, {:f}, {:f})", c.r, c.g, c.b); };
  std::string text =
      fmt::format("\nvec3 false_color(float place) {{\n  vec3 code = {};\n", vec3(kStops[0].code));
  for (std::size_t i = 1; i < kStops.size(); ++i)
    text += fmt::format("  code = mix(code, {}, clamp((place - {:f}) / {:f}, 0.0, 1.0));\n",
                        vec3(kStops[i].code), kStops[i - 1].place, kStops[i].place - kStops[i - 1].place);
  return text + "  return code;\n}\n";
}

}  // namespace sconce
