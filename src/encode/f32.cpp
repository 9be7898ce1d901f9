// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>

#include "encode/rows.h"

namespace sconce {

static_assert(std::endian::native == std::endian::little);

namespace {

void encode_f32(std::span<const float> rgb, std::span<std::byte> texels) {
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float v = std::isnan(rgb[i]) ? 0.0f : rgb[i];
    std::memcpy(&texels[4 * i], &v, 4);
  }
}

void decode_f32(std::span<const std::byte> texels, std::span<float> rgb) {
  if (!rgb.empty()) std::memcpy(rgb.data(), texels.data(), rgb.size_bytes());
}

}  // namespace

constexpr Encoding kEncodingF32{
    "f32",
    "32-bit float: exact, 12 bytes per texel",
    0,
    FLT_MIN,
    FLT_MAX,
    true,
    PixelType::full,
    12,
    encode_f32,
    decode_f32,
};

}  // namespace sconce
