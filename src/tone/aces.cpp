// SPDX-License-Identifier: Apache-2.0
// ACES RRT + sRGB ODT as fitted by Stephen Hill (published in M. Pettineo's BakingLab, ACES.hlsl, MIT). The
// plain fit: middle grey 0.18 becomes 0.106, as in ACES' own transform; no brightening factor.
#include "tone/curve.h"

namespace sconce {

namespace {

// sRGB -> XYZ -> D60 -> AP1 with the RRT's desaturation, and back with the ODT's.
constexpr std::array<Rgb, 3> kInput{Rgb(0.59719f, 0.35458f, 0.04823f), Rgb(0.07600f, 0.90834f, 0.01566f),
                                    Rgb(0.02840f, 0.13383f, 0.83777f)};
constexpr std::array<Rgb, 3> kOutput{Rgb(1.60475f, -0.53108f, -0.07367f), Rgb(-0.10208f, 1.10813f, -0.00605f),
                                     Rgb(-0.00327f, -0.07276f, 1.07602f)};

float fit(float v, const ToneParams&) {
  return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
}

}  // namespace

const ToneCurve kAcesCurve{ToneCurve::Kind::channels, fit, {}, kInput, kOutput};

Rgb tone_aces(const Rgb& exposed, const ToneParams& params) {
  return curve::apply(kAcesCurve, exposed, params);
}

}  // namespace sconce
