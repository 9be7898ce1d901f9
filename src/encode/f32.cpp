// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cfloat>

#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

static_assert(std::endian::native == std::endian::little);

namespace {

void encode_f32(const Image& image, EncodedImage& out) {
  texels::encode_channels<float>(image, out, [](float v, float) { return texels::clean(v); });
}

void decode_f32(const EncodedImage& in, int first, int rows, float* out) {
  texels::decode_channels<float>(in, first, rows, out, [](float v, float) { return v; });
}

constexpr std::string_view kGlsl =
#include "encode/f32.glsl.h"
    ;

}  // namespace

constexpr Encoding kEncodingF32{
    .name = "f32",
    .doc = "32-bit float: exact; 12 bytes per texel",
    .max_relative_error = 0,
    .smallest = FLT_MIN,
    .largest = FLT_MAX,
    .is_signed = true,
    .per_channel = true,
    .filters = true,
    .has_gain = false,
    .type = TexelType::f32,
    .stored_channels = 0,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_f32,
    .decode = decode_f32,
};

}  // namespace sconce
