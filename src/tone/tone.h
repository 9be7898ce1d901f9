// SPDX-License-Identifier: Apache-2.0
// Tone curves. Adding one is one file and one row of table.cpp. How to come from metering, --exposure and
// --ev100 to exposed colours and ToneParams: tone/exposure.h. Whole pictures: tone/apply.h.
#pragma once

#include <span>
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

struct ToneMapper {
  std::string_view name, doc;
  /// -> display-linear Rec. 709 in [0,1], before the sRGB transfer. Any input is allowed: negative and NaN
  /// channels count as 0, infinities as very bright.
  Rgb (*map)(const Rgb& exposed, const ToneParams& params);
  bool needs_maximum = false;
  bool luminance_curve = false;  ///< t = c * l_out / l_in, then clamped to [0,1]: a 1-D table serves the GPU
};

/// agx (default), drago, drago2006, reinhard, aces, neutral, linear; in this order.
std::span<const ToneMapper> tone_mappers();
/// @throws UsageError naming the choices
const ToneMapper& find_tone_mapper(std::string_view name);

}  // namespace sconce
