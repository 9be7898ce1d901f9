// SPDX-License-Identifier: Apache-2.0
// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images": the global curve with a white
// point.
#include "tone/curve.h"

namespace sconce {

double reinhard_luminance(double l, double white) {
  return l * (1 + l / (white * white)) / (1 + l);
}

Rgb tone_reinhard(const Rgb& exposed, const ToneParams& params) {
  const Rgb c = curve::clean(exposed);
  const float l = luminance(c);
  // White below 1 would stretch a scene without highlights instead of compressing it.
  const double white = std::max(1.0f, params.maximum);
  return curve::by_luminance(c, l, static_cast<float>(reinhard_luminance(std::min(double{l}, white), white)));
}

}  // namespace sconce
