// SPDX-License-Identifier: Apache-2.0
// IEEE 754 binary16 <-> binary32, all codes: subnormals, infinities, NaN.
#pragma once

#include <bit>
#include <cstdint>

namespace sconce {

inline constexpr float kLargestHalf = 65504.0f;
inline constexpr float kSmallestNormalHalf = 0x1p-14f;

/// Exact for every code; NaN payloads are kept. Without branches, so that loops over it become vectors, and
/// without subnormal floats, which threads may have been told to take for 0 (DAZ; libraries leave it behind).
constexpr float half_to_float(uint16_t h) {
  const uint32_t sign = static_cast<uint32_t>(h & 0x8000u) << 16, rest = static_cast<uint32_t>(h & 0x7fffu)
                                                                         << 13;
  const uint32_t number = rest + 0x38000000u;  // exponents are off by 112
  // A subnormal's mantissa behind a leading one, which is then taken away.
  const auto small = std::bit_cast<uint32_t>(std::bit_cast<float>(rest + 0x38800000u) - kSmallestNormalHalf);
  return std::bit_cast<float>(sign | (rest >= 0x0f800000u  ? rest | 0x7f800000u
                                      : rest < 0x00800000u ? small
                                                           : number));
}

/// Rounded to nearest, ties to even; above 65519.996 infinity, as in IEEE 754. NaN stays NaN.
constexpr uint16_t float_to_half(float f) {
  const uint32_t bits = std::bit_cast<uint32_t>(f);
  const auto sign = static_cast<uint16_t>((bits >> 16) & 0x8000u);
  const uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<uint16_t>(sign | 0x7e00u | ((magnitude >> 13) & 0x3ffu));
  if (magnitude >= 0x477ff000u) return sign | 0x7c00u;  // 65520 and above
  if (magnitude >= 0x38800000u) {                       // normal: drop 13 bits, round, rebias the exponent
    const uint32_t odd = (magnitude >> 13) & 1u;
    return static_cast<uint16_t>(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
  }
  // Subnormal: adding 0.5 makes the float unit round at 2^-24, to nearest even.
  const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
  return static_cast<uint16_t>(sign | (std::bit_cast<uint32_t>(shifted) - 0x3f000000u));
}

}  // namespace sconce
