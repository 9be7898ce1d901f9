// SPDX-License-Identifier: Apache-2.0
// A ToneCurve as a table over the logarithm of its variable, for shaders that look up rather than compute.
#pragma once

#include <string>
#include <vector>

#include "tone/tone.h"

namespace sconce {

/// Piecewise linear over log2 of the variable. Within 0.5/255 of the curve after the sRGB transfer, for any
/// colour.
struct ToneLut {
  ToneCurve curve;
  float low = 0, high = 0;    ///< log2 of the variable at the first and the last entry
  std::vector<float> values;  ///< channels: f(v); luminance: the gain f(l) / l

  /// f by the table; below it as its first entry, above it as its last one.
  float f(float v) const;
  /// -> display-linear in [0,1], as ToneMapper::map.
  Rgb map(const Rgb& exposed) const;
};

/// @pre mapper.curve != nullptr
ToneLut make_tone_lut(const ToneMapper& mapper, const ToneParams& params, int entries = 1024);

/// As tone_glsl(mapper), by the table: it lies in the only row of `uniform sampler2D tone_lut`, one float
/// channel, unfiltered. What the ToneParams of tone_map() say is ignored.
std::string tone_glsl(const ToneLut& lut);

}  // namespace sconce
