// SPDX-License-Identifier: Apache-2.0
// System A's 8-bit packing (GRAPP 2006, "exponential packing": x1 = 1 - e^-x), with a gain per layer.
#include <algorithm>
#include <array>

#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

constexpr int kTop = 254;  // the last code: 255 would be infinite

uint8_t to_code(float v, float gain) {
  const double packed = -std::expm1(-static_cast<double>(texels::clean_positive(v)) * gain);
  return static_cast<uint8_t>(std::min<long>(kTop, std::lround(255.0 * packed)));
}

const std::array<float, 256>& values() {
  static const std::array<float, 256> made = [] {
    std::array<float, 256> all{};
    for (int code = 0; code < 256; ++code)
      all[static_cast<std::size_t>(code)] = static_cast<float>(-std::log1p(-std::min(code, kTop) / 255.0));
    return all;
  }();
  return made;
}

void encode_exp8(const Image& image, EncodedImage& out) {
  texels::encode_channels<uint8_t>(image, out, to_code);
}

void decode_exp8(const EncodedImage& in, int first, int rows, float* out) {
  const std::array<float, 256>& table = values();
  texels::decode_channels<uint8_t>(in, first, rows, out,
                                   [&](uint8_t code, float gain) { return table[code] / gain; });
}

constexpr std::string_view kGlsl =
#include "encode/exp8.glsl.h"
    ;

}  // namespace

// Half a step is e^x / 510: 10 % of x from 0.0198 up to the top code's ln 255.
constexpr Encoding kEncodingExp8{
    .name = "exp8",
    .doc = "8 bits, 1 - exp(-gain x): 10 % over 1:280, 1 % over 1:10; 3 bytes per texel",
    .max_relative_error = 0.1,
    .smallest = 0.0198f,
    .largest = 5.5412635f,
    .is_signed = false,
    .per_channel = true,
    .filters = false,
    .has_gain = true,
    .type = TexelType::u8,
    .stored_channels = 0,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_exp8,
    .decode = decode_exp8,
};

}  // namespace sconce
