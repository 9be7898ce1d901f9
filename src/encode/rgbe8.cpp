// SPDX-License-Identifier: Apache-2.0
// Ward's shared exponent ("Real Pixels", Graphics Gems II; as in the Radiance sources), which system A named
// and did not build. Mantissas are read at the middle of their step.
#include <algorithm>

#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

void encode_rgbe8(const Image& image, EncodedImage& out) {
  texels::encode_rgb(image, out, [](const float* rgb, unsigned char* bytes) {
    float c[3];
    for (int k = 0; k < 3; ++k) c[k] = std::min(texels::clean_positive(rgb[k]), 1.7e38f);
    int exponent = 0;
    std::frexp(std::max({c[0], c[1], c[2]}), &exponent);
    const bool zero = !(std::max({c[0], c[1], c[2]}) > 1e-32f);
    for (int k = 0; k < 3; ++k)
      bytes[k] = zero ? 0 : static_cast<unsigned char>(std::ldexp(c[k], 8 - exponent));
    bytes[3] = zero ? 0 : static_cast<unsigned char>(exponent + 128);
  });
}

void decode_rgbe8(const EncodedImage& in, int first, int rows, float* out) {
  texels::decode_rgb(in, first, rows, out, [](const unsigned char* bytes, float* rgb) {
    const float step = bytes[3] == 0 ? 0.0f : std::ldexp(1.0f, bytes[3] - 136);
    for (int k = 0; k < 3; ++k) rgb[k] = (static_cast<float>(bytes[k]) + 0.5f) * step;
  });
}

constexpr std::string_view kGlsl =
#include "encode/rgbe8.glsl.h"
    ;

}  // namespace

constexpr Encoding kEncodingRgbe8{
    .name = "rgbe8",
    .doc = "8-bit mantissas, shared exponent (Ward): 0.39 % of the largest channel; 4 bytes per texel",
    .max_relative_error = 0x1p-8,
    .smallest = 1e-32f,
    .largest = 1.6e38f,
    .is_signed = false,
    .per_channel = false,
    .filters = false,
    .has_gain = false,
    .type = TexelType::u8,
    .stored_channels = 4,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_rgbe8,
    .decode = decode_rgbe8,
};

}  // namespace sconce
