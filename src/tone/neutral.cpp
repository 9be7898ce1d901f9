// SPDX-License-Identifier: Apache-2.0
// Khronos PBR Neutral Tone Mapper, after its specification (github.com/KhronosGroup/ToneMapping,
// PBR_Neutral/README.md).
#include "tone/curve.h"

namespace sconce {

Rgb tone_neutral(const Rgb& exposed, const ToneParams&) {
  constexpr float kF90 = 0.04f, kStart = 0.8f - kF90, kDesaturation = 0.15f;
  const Rgb c = curve::clean(exposed);
  const float x = std::min({c.r, c.g, c.b});
  const float f = x <= 2 * kF90 ? x - x * x / (4 * kF90) : kF90;
  const Rgb d = c - Rgb(f);
  const float peak = d.max();
  if (peak <= kStart) return curve::to_unit(d);
  const float new_peak = 1 - (1 - kStart) * (1 - kStart) / (peak + 1 - 2 * kStart);
  const float g = 1 / (kDesaturation * (peak - new_peak) + 1);
  return curve::to_unit(d * (new_peak / peak * g) + Rgb(new_peak * (1 - g)));
}

}  // namespace sconce
