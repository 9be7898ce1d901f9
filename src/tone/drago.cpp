// SPDX-License-Identifier: Apache-2.0
// Drago's adaptive logarithmic curve: `drago` with Rec. 709 luminance and a guard against its rise above 1,
// and `drago2006` as in system A's paper: BT.601 luminance, the formula explicitly, no guard.
#include "tone/curve.h"

namespace sconce {

double drago_luminance(double x, double maximum, double bias) {
  if (!(x > 0) || !(maximum > 0)) return 0;
  const double p = std::log(bias) / std::log(0.5);
  return std::log1p(x) / (std::log10(maximum + 1) * std::log(2 + 8 * std::pow(x / maximum, p)));
}

double drago_smallest_bias(double maximum) {
  const double p = std::log(10.0) / (0.8 * std::log1p(maximum) * (maximum + 1) / maximum);
  return std::pow(0.5, p);
}

namespace {

float drago(float l, const ToneParams& params, bool guarded) {
  const double maximum = std::max(1e-6, double{params.maximum} / params.adaptation);
  const double x = std::min(maximum, double{l} / params.adaptation);
  const double bias =
      guarded ? std::max(double{params.drago_bias}, drago_smallest_bias(maximum)) : params.drago_bias;
  return static_cast<float>(drago_luminance(x, maximum, bias));
}

float guarded(float l, const ToneParams& params) {
  return drago(l, params, true);
}
float unguarded(float l, const ToneParams& params) {
  return drago(l, params, false);
}

}  // namespace

const ToneCurve kDragoCurve{ToneCurve::Kind::luminance, guarded, kRec709};
const ToneCurve kDrago2006Curve{ToneCurve::Kind::luminance, unguarded, kRec601};

Rgb tone_drago(const Rgb& exposed, const ToneParams& params) {
  return curve::apply(kDragoCurve, exposed, params);
}

Rgb tone_drago2006(const Rgb& exposed, const ToneParams& params) {
  return curve::apply(kDrago2006Curve, exposed, params);
}

}  // namespace sconce
