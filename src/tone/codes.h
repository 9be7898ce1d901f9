// SPDX-License-Identifier: Apache-2.0
// Linear colours to the codes of a display, for pictures that must be quick: tables instead of logarithms and
// powers, looked up by vectors (Highway, chosen at run time).
#pragma once

#include <vector>

#include "image/image.h"
#include "tone/exposure.h"

namespace sconce {

/// A piecewise linear function of v >= 0 in pieces of equal share of an octave, so that a float's own bits
/// number the piece. Constant below 2^kLow and from 2^kHigh on.
struct OctaveTable {
  static constexpr int kLow = -30, kHigh = 30, kBits = 6;  ///< 2^kBits pieces per octave
  static constexpr int kShift = 23 - kBits, kFirst = (127 + kLow) << kBits;

  std::vector<float> base, slope;  ///< f(v) = base + slope * v; entry 0 and the last one are the constants

  float operator()(float v) const;
};

/// Exposure, tone curve, sRGB transfer and rounding of one setting. Within one code of tone_map(), for any
/// colour.
class ToneCodes {
 public:
  /// Curves without a ToneCurve are computed colour by colour; only their sRGB transfer is a table.
  ToneCodes(const Exposure& exposure, const ToneMapper& mapper);

  /// @param linear  3 * pixels: R, G, B as tone_map() wants them
  /// @param codes   3 * pixels
  void map(const float* linear, std::size_t pixels, unsigned char* codes) const;
  /// A whole picture. @throws Error where it is not R, G, B
  Image8 map(const Image& linear) const;

  struct Tables {
    ToneCurve curve;
    float scale = 1;               ///< exposure
    OctaveTable f;                 ///< channels: f(v); luminance: the gain f(l) / l
    std::vector<uint8_t> display;  ///< codes of [0,1], evenly; three bytes more, for reads of four
  };

 private:
  Exposure exposure_;
  const ToneMapper* mapper_;
  Tables tables_;
};

}  // namespace sconce
