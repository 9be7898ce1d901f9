// SPDX-License-Identifier: Apache-2.0
// Tone curves. Adding one is one file and one row of table.cpp.
#pragma once

#include <span>
#include <string_view>

#include "core/rgb.h"

namespace sconce {

/// What curves may use beside the colour. The colour comes in exposed: 0.18 is middle grey after exposure.
struct ToneParams {
  float maximum = 16.0f;      ///< largest exposed luminance of the scene; curves that need one clamp their input to it
  float drago_bias = 0.85f;
};

struct ToneMapper {
  std::string_view name, doc;
  Rgb (*map)(const Rgb& exposed, const ToneParams& params);  ///< -> display-linear Rec. 709 in [0,1], before the sRGB transfer
  bool needs_maximum = false;
  bool luminance_curve = false;  ///< t = c * l_out / l_in: a 1-D table serves the GPU
};

/// agx (default), drago, drago2006, reinhard, aces, neutral, linear; in this order.
std::span<const ToneMapper> tone_mappers();
/// @throws UsageError naming the choices
const ToneMapper& find_tone_mapper(std::string_view name);

}  // namespace sconce
