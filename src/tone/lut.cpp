// SPDX-License-Identifier: Apache-2.0
#include "tone/lut.h"

#include <fmt/format.h>

#include "tone/curve.h"

namespace sconce {

namespace {

constexpr std::string_view kCommonGlsl =
#include "tone/common.glsl.h"
    ;
constexpr std::string_view kLutGlsl =
#include "tone/lut.glsl.h"
    ;

std::string rows(const std::array<Rgb, 3>& m) {
  return fmt::format("mat3({:.9e}, {:.9e}, {:.9e}, {:.9e}, {:.9e}, {:.9e}, {:.9e}, {:.9e}, {:.9e})", m[0].r,
                     m[0].g, m[0].b, m[1].r, m[1].g, m[1].b, m[2].r, m[2].g, m[2].b);
}

}  // namespace

float ToneLut::f(float v) const {
  const float last = static_cast<float>(values.size() - 1);
  const float at = std::clamp((std::log2(std::max(v, 1e-30f)) - low) / (high - low), 0.0f, 1.0f) * last;
  const auto i = static_cast<std::size_t>(std::min(at, last - 1));
  const float w = at - static_cast<float>(i);
  const float value = (1 - w) * values[i] + w * values[i + 1];
  return curve.kind == ToneCurve::Kind::luminance ? value * std::min(v, std::exp2(high)) : value;
}

Rgb ToneLut::map(const Rgb& exposed) const {
  return curve::apply(curve, exposed, [&](float v) { return f(v); });
}

ToneLut make_tone_lut(const ToneMapper& mapper, const ToneParams& params, int entries) {
  ToneLut lut;
  lut.curve = *mapper.curve;
  const bool luminance = lut.curve.kind == ToneCurve::Kind::luminance;
  if (luminance) {
    // Constant from the scene's maximum on, or from 1 on.
    const float maximum = std::max(params.maximum, 1e-6f * params.adaptation);
    lut.high = std::log2(lut.curve.f(1, params) > lut.curve.f(maximum, params) ? 1.0f : maximum);
  } else {
    lut.high = 14;  // all but constant from here on
  }
  // What is darker is below half a code, for the most saturated colour too.
  lut.low = std::min(-14.0f, lut.high) - 10;
  for (int i = 0; i < entries; ++i) {
    const float v =
        std::exp2(lut.low + (lut.high - lut.low) * static_cast<float>(i) / static_cast<float>(entries - 1));
    lut.values.push_back(lut.curve.f(v, params) / (luminance ? v : 1.0f));
  }
  return lut;
}

std::string tone_glsl(const ToneLut& lut) {
  const bool luminance = lut.curve.kind == ToneCurve::Kind::luminance;
  const Rgb& w = lut.curve.weights;
  return fmt::format(
      "{}\nconst float tone_low = {:.9e}, tone_high = {:.9e}, tone_power = {:.9e};\n"
      "const vec3 tone_weights = vec3({:.9e}, {:.9e}, {:.9e});\n"
      "const mat3 tone_before = {}, tone_after = {};  // by rows, hence multiplied from the right\n{}\n"
      "vec3 tone_map(vec3 exposed, ToneParams p) {{\n  return tone_lut_{}(exposed);\n}}\n",
      kCommonGlsl, lut.low, lut.high, lut.curve.power, w.r, w.g, w.b, rows(lut.curve.before),
      rows(lut.curve.after), kLutGlsl, luminance ? "luminance" : "channels");
}

}  // namespace sconce
