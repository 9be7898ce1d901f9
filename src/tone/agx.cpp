// SPDX-License-Identifier: Apache-2.0
// AgX by Troy Sobotka (github.com/sobotka/AgX), base look: inset matrix, log2 over 16.5 stops around middle
// grey, sigmoid, outset matrix, 2.2 power display. Matrices as given in B. Wrensch, "Minimal AgX
// Implementation"; the sigmoid is the definition, not the polynomial fitted to it.
#include "tone/curve.h"

namespace sconce {

namespace {

constexpr std::array<Rgb, 3> kInset{Rgb(0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f),
                                    Rgb(0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f),
                                    Rgb(0.0423756549057051f, 0.0784336f, 0.879142973793104f)};
constexpr std::array<Rgb, 3> kOutset{Rgb(1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f),
                                     Rgb(-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f),
                                     Rgb(-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f)};

constexpr float kBelowGrey = 10.0f, kAboveGrey = 6.5f;  // stops
constexpr float kLogGrey = -2.47393118833f;             // log2 of 0.18

/// Through the pivot (10/16.5, 0.5) with slope 2, reaching 0 and 1 at the ends; power 3 below, 3.25 above.
float sigmoid(float x) {
  constexpr float kPivot = kBelowGrey / (kBelowGrey + kAboveGrey), kSlope = 2.0f;
  if (x <= 0 || x >= 1) return x <= 0 ? 0.0f : 1.0f;  // exactly, where floats would miss by an ulp
  const bool above = x > kPivot;
  const float d = std::abs(x - kPivot);
  const float power = above ? 3.25f : 3.0f;
  // scale = ((slope * reach / 0.5)^power - 1) / reach^power makes the curve meet its end exactly.
  const float scale = above ? 69.86278913545539f : 59.507875f;
  const float y = kSlope * d * std::pow(1.0f + scale * std::pow(d, power), -1.0f / power);
  return 0.5f + (above ? y : -y);
}

float log_coded(float v, const ToneParams&) {
  const float stops = std::log2(std::max(v, 1e-10f)) - kLogGrey;
  return sigmoid(std::clamp((stops + kBelowGrey) / (kBelowGrey + kAboveGrey), 0.0f, 1.0f));
}

}  // namespace

const ToneCurve kAgxCurve{ToneCurve::Kind::channels, log_coded, {}, kInset, kOutset, 2.2f};

Rgb tone_agx(const Rgb& exposed, const ToneParams& params) {
  return curve::apply(kAgxCurve, exposed, params);
}

}  // namespace sconce
