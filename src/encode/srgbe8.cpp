// SPDX-License-Identifier: Apache-2.0
// Signed shared exponent: system D's sRGBE (Granier et al. 2003, appendix A), with 0 made exact: mantissas
// are whole numbers from -127 to 127 around code 128.
#include <algorithm>

#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

constexpr int kLowest = -126;  // smallest exponent; stored + 128, 0 = black
constexpr float kLargest = 0x1p127f;

void encode_srgbe8(const Image& image, EncodedImage& out) {
  texels::encode_rgb(image, out, [](const float* rgb, unsigned char* bytes) {
    float c[3], most = 0;
    for (int k = 0; k < 3; ++k) {
      c[k] = std::clamp(texels::clean(rgb[k]), -kLargest, kLargest);
      most = std::max(most, std::abs(c[k]));
    }
    int exponent = 0;
    if (std::frexp(most, &exponent) == 0.5f) --exponent;  // a power of two is 127 steps, not 63.5
    const bool zero = most == 0 || exponent < kLowest;
    for (int k = 0; k < 3; ++k) {
      const long q = zero ? 0 : std::lround(std::ldexp(c[k], -exponent) * 127.0f);
      bytes[k] = static_cast<unsigned char>(128 + std::clamp(q, -127L, 127L));
    }
    bytes[3] = zero ? 0 : static_cast<unsigned char>(exponent + 128);
  });
}

void decode_srgbe8(const EncodedImage& in, int first, int rows, float* out) {
  texels::decode_rgb(in, first, rows, out, [](const unsigned char* bytes, float* rgb) {
    for (int k = 0; k < 3; ++k)
      rgb[k] = bytes[3] == 0 ? 0.0f : std::ldexp(static_cast<float>(bytes[k] - 128) / 127.0f, bytes[3] - 128);
  });
}

constexpr std::string_view kGlsl =
#include "encode/srgbe8.glsl.h"
    ;

}  // namespace

constexpr Encoding kEncodingSrgbe8{
    .name = "srgbe8",
    .doc =
        "signed 8-bit mantissas, shared exponent, exact 0: 0.79 % of the largest channel; 4 bytes per texel",
    .max_relative_error = 1.0 / 127.0,
    .smallest = 1.2e-38f,
    .largest = kLargest,
    .is_signed = true,
    .per_channel = false,
    .filters = false,
    .has_gain = false,
    .type = TexelType::u8,
    .stored_channels = 4,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_srgbe8,
    .decode = decode_srgbe8,
};

}  // namespace sconce
