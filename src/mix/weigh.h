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

/// sum += weight * decoded, for rows [first, first + rows) of the texture.
/// @param tables     of its encoding
/// @param weights    one where the texture holds colours; else one per channel, each times its group's colour
/// @param luminance  the texture's channels are groups' luminances
/// @param sum        3 * width * rows floats
/// @pre tables.kind != none
void add_weighted(const WeighTables& tables, const EncodedImage& texture, int first, int rows,
                  std::span<const Rgb> weights, bool luminance, float* sum);

/// The same plainly, by Encoding::decode: what the fast one is tested and measured against.
void add_weighted_plain(const EncodedImage& texture, int first, int rows, std::span<const Rgb> weights,
                        bool luminance, float* sum);

}  // namespace sconce
