// SPDX-License-Identifier: Apache-2.0
// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images": the global curve with a white
// point.
#include "tone/curve.h"

namespace sconce {

double reinhard_luminance(double l, double white) {
  return l * (1 + l / (white * white)) / (1 + l);
}

namespace {

float to_white(float l, const ToneParams& params) {
  // White below 1 would stretch a scene without highlights instead of compressing it.
  const double white = std::max(1.0f, params.maximum);
  return static_cast<float>(reinhard_luminance(std::min(double{l}, white), white));
}

}  // namespace

const ToneCurve kReinhardCurve{ToneCurve::Kind::luminance, to_white, kRec709};

Rgb tone_reinhard(const Rgb& exposed, const ToneParams& params) {
  return curve::apply(kReinhardCurve, exposed, params);
}

}  // namespace sconce
