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

/// Rows of a 3 x 3 matrix applied to a colour.
inline Rgb apply(const std::array<Rgb, 3>& rows, const Rgb& c) {
  return {luminance(c, rows[0]), luminance(c, rows[1]), luminance(c, rows[2])};
}

/// ToneCurve's definition; luminance is preserved for any weights, black stays black.
/// @param f  ToneCurve::f, or a table of it
template <class F>
Rgb apply(const ToneCurve& curve, const Rgb& exposed, F f) {
  const Rgb c = clean(exposed);
  Rgb t;
  if (curve.kind == ToneCurve::Kind::luminance) {
    const float l = luminance(c, curve.weights);
    if (l > 0) t = c * (f(l) / l);
  } else {
    const Rgb v = apply(curve.before, c);
    t = apply(curve.after, {f(v.r), f(v.g), f(v.b)});
  }
  t = to_unit(t);
  if (curve.power != 1)
    t = {std::pow(t.r, curve.power), std::pow(t.g, curve.power), std::pow(t.b, curve.power)};
  return t;
}
inline Rgb apply(const ToneCurve& curve, const Rgb& exposed, const ToneParams& params) {
  return apply(curve, exposed, [&](float v) { return curve.f(v, params); });
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

extern const ToneCurve kAgxCurve, kDragoCurve, kDrago2006Curve, kReinhardCurve, kAcesCurve;

Rgb tone_agx(const Rgb& exposed, const ToneParams& params);
Rgb tone_drago(const Rgb& exposed, const ToneParams& params);
Rgb tone_drago2006(const Rgb& exposed, const ToneParams& params);
Rgb tone_reinhard(const Rgb& exposed, const ToneParams& params);
Rgb tone_aces(const Rgb& exposed, const ToneParams& params);
Rgb tone_neutral(const Rgb& exposed, const ToneParams& params);
Rgb tone_linear(const Rgb& exposed, const ToneParams& params);

}  // namespace sconce
