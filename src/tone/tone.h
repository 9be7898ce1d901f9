// SPDX-License-Identifier: Apache-2.0
// Tone curves. Adding one is one file and one row of table.cpp. How to come from metering, --exposure and
// --ev100 to exposed colours and ToneParams: tone/exposure.h. Whole pictures: tone/apply.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/rgb.h"

namespace sconce {

inline constexpr float kMiddleGrey = 0.18f;  ///< what the adaptation luminance becomes by exposure

/// What curves may use beside the colour. The colour comes in exposed: kMiddleGrey is middle grey after
/// exposure.
struct ToneParams {
  float maximum =
      16.0f;  ///< largest exposed luminance of the scene; curves that need one clamp their input to it
  float adaptation = kMiddleGrey;  ///< exposed luminance the eye is adapted to: L_wa of drago
  float drago_bias = 0.85f;        ///< in (0, 1)
};

/// A tone curve whose heart is a function f of one variable, so that a one-dimensional table serves for it
/// (tone/lut.h).
struct ToneCurve {
  /// luminance: t = c * f(l) / l with l = weights . c. channels: t = after * f(before * c), f channel by
  /// channel. Then clamped to [0,1] and raised to `power`.
  enum class Kind : uint8_t { luminance, channels } kind = Kind::luminance;
  float (*f)(float v, const ToneParams& params) = nullptr;  ///< @pre 0 <= v <= 1e9
  Rgb weights{};                                            ///< of the luminance
  std::array<Rgb, 3> before{}, after{};                     ///< rows of matrices
  float power = 1;
};

struct ToneMapper {
  std::string_view name, doc;
  /// -> display-linear Rec. 709 in [0,1], before the sRGB transfer. Any input is allowed: negative and NaN
  /// channels count as 0, infinities as very bright.
  Rgb (*map)(const Rgb& exposed, const ToneParams& params);
  bool needs_maximum = false;
  const ToneCurve* curve = nullptr;  ///< where there is one
  std::string_view glsl;  ///< the twin: vec3 tone_NAME(vec3 exposed, ToneParams p), for after common.glsl
};

/// agx (default), drago, drago2006, reinhard, aces, neutral, linear; in this order.
std::span<const ToneMapper> tone_mappers();
/// @throws UsageError naming the choices
const ToneMapper& find_tone_mapper(std::string_view name);

/// Functions for a shader (GLSL 4.50, 3.30, ES 3.00): struct ToneParams, vec3 tone_map(vec3 exposed,
/// ToneParams p) by this curve, vec3 linear_to_srgb(vec3 c).
std::string tone_glsl(const ToneMapper& mapper);

}  // namespace sconce
