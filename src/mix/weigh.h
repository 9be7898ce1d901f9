// SPDX-License-Identifier: Apache-2.0
// One band of a weighted sum, straight from the codes: decoding and weighting in one go, by the widest
// vectors of the processor it runs on (Highway, chosen at run time).
#pragma once

#include <array>
#include <span>

#include "encode/encoding.h"

namespace sconce {

/// What an encoding's codes mean, as vectors look it up; found by decoding every code once.
struct WeighTables {
  enum class Kind : uint8_t {
    f32,
    f16,
    table,   ///< value[code]
    pair,    ///< value[1] * high + low[1] * low: two planes, which decode linearly (a test holds them to it)
    shared,  ///< value[mantissa] * low[alpha]
    none,    ///< blocks have no codes of single texels
  } kind = Kind::none;
  alignas(64) std::array<float, 256> value{}, low{};

  explicit WeighTables(const Encoding& encoding);
};

/// A texture and what each of its groups counts.
struct Weighted {
  const WeighTables& tables;  ///< of its encoding; not of kind none
  const EncodedImage& texture;
  std::span<const Rgb>
      weights;     ///< one where it holds colours; else one per channel, each times its group's colour
  bool luminance;  ///< its channels are groups' luminances
};

/// sum += weight * decoded, one texture after the other, for rows [first, first + rows) of them.
/// @param terms  textures of one size
/// @param sum    3 * width * rows floats
void add_weighted(std::span<const Weighted> terms, int first, int rows, float* sum);

/// The same plainly, by Encoding::decode: what the fast one is tested and measured against.
void add_weighted_plain(const EncodedImage& texture, int first, int rows, std::span<const Rgb> weights,
                        bool luminance, float* sum);

}  // namespace sconce
