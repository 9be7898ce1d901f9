// SPDX-License-Identifier: Apache-2.0
// Shared by the curves of this module.
#pragma once

#include <algorithm>
#include <cmath>

#include "tone/tone.h"

namespace sconce {

namespace curve {

/// A channel as curves want it: NaN and negative become 0, anything above 1e9 becomes 1e9.
inline float clean(float v) {
  return v > 0 ? std::min(v, 1e9f) : 0.0f;
}
inline Rgb clean(const Rgb& c) {
  return {clean(c.r), clean(c.g), clean(c.b)};
}

inline Rgb to_unit(const Rgb& c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

/// t = c * l_out / l_in: luminance is preserved for any weights, black stays black; then clamped channel by
/// channel.
inline Rgb by_luminance(const Rgb& c, float l_in, float l_out) {
  return l_in > 0 ? to_unit(c * (l_out / l_in)) : Rgb{};
}

/// Rows of a 3 x 3 matrix applied to a colour.
struct Matrix {
  float m[3][3];
  constexpr Rgb operator*(const Rgb& c) const {
    return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b, m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
            m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
  }
};

template <class F>
Rgb per_channel(const Rgb& c, F f) {
  return {f(c.r), f(c.g), f(c.b)};
}

}  // namespace curve

// Luminance curves on their own, for tables and tests. Relative luminances in and out.

/// Drago et al. 2003, "Adaptive Logarithmic Mapping For Displaying High Contrast Scenes", with Ldmax = 100
/// cd/m2: 1/log10(M+1) * ln(1+x) / ln(2 + 8 (x/M)^p), p = ln bias / ln 0.5. x and M are relative to the
/// adaptation luminance. The paper's rescaling of the adaptation for a bias other than 0.85 is left to the
/// caller.
double drago_luminance(double x, double maximum, double bias);
/// The smallest bias for which drago_luminance is monotone up to its maximum: 0.5^p_max,
/// p_max = ln 10 / (0.8 ln(M+1) (M+1)/M).
double drago_smallest_bias(double maximum);
/// Reinhard et al. 2002, eq. 4: L (1 + L / white^2) / (1 + L).
double reinhard_luminance(double l, double white);

Rgb tone_agx(const Rgb& exposed, const ToneParams& params);
Rgb tone_drago(const Rgb& exposed, const ToneParams& params);
Rgb tone_drago2006(const Rgb& exposed, const ToneParams& params);
Rgb tone_reinhard(const Rgb& exposed, const ToneParams& params);
Rgb tone_aces(const Rgb& exposed, const ToneParams& params);
Rgb tone_neutral(const Rgb& exposed, const ToneParams& params);
Rgb tone_linear(const Rgb& exposed, const ToneParams& params);

}  // namespace sconce
