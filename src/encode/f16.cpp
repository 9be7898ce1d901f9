// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include "encode/half.h"
#include "encode/rows.h"

namespace sconce {

namespace {

void encode_f16(std::span<const float> rgb, std::span<std::byte> texels) {
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float v = std::isnan(rgb[i]) ? 0.0f : std::clamp(rgb[i], -kLargestHalf, kLargestHalf);
    const uint16_t h = float_to_half(v);
    std::memcpy(&texels[2 * i], &h, 2);
  }
}

void decode_f16(std::span<const std::byte> texels, std::span<float> rgb) {
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    uint16_t h = 0;
    std::memcpy(&h, &texels[2 * i], 2);
    rgb[i] = half_to_float(h);
  }
}

}  // namespace

// 10 stored bits: half a step is 2^-11 of the power of two below the value. Below the smallest normal the
// error is absolute, 2^-25.
constexpr Encoding kEncodingF16{
    "f16",           "16-bit float: 0.049 % over 1:1.07e9, 6 bytes per texel",
    0x1p-11,         kSmallestNormalHalf,
    kLargestHalf,    true,
    PixelType::half, 6,
    encode_f16,      decode_f16,
};

}  // namespace sconce
