// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "encode/half.h"
#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

void encode_f16(const Image& image, EncodedImage& out) {
  texels::encode_channels<uint16_t>(image, out, [](float v, float) {
    return float_to_half(std::clamp(texels::clean(v), -kLargestHalf, kLargestHalf));
  });
}

void decode_f16(const EncodedImage& in, int first, int rows, float* out) {
  texels::decode_channels<uint16_t>(in, first, rows, out, [](uint16_t h, float) { return half_to_float(h); });
}

constexpr std::string_view kGlsl =
#include "encode/f16.glsl.h"
    ;

}  // namespace

// 10 stored bits: half a step is 2^-11 of the power of two below the value. Below the smallest normal the
// error is absolute, 2^-25.
constexpr Encoding kEncodingF16{
    .name = "f16",
    .doc = "16-bit float: 0.049 % over 1:1.07e9; 6 bytes per texel",
    .max_relative_error = 0x1p-11,
    .smallest = kSmallestNormalHalf,
    .largest = kLargestHalf,
    .is_signed = true,
    .per_channel = true,
    .filters = true,
    .has_gain = false,
    .type = TexelType::f16,
    .stored_channels = 0,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_f16,
    .decode = decode_f16,
};

}  // namespace sconce
