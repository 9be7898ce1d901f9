// SPDX-License-Identifier: Apache-2.0
// Several 8-bit exposures of one layer (Cohen et al. 2001, "Real-Time High Dynamic Range Texture Mapping"),
// which system A named and did not build. The two exposures lie 256 apart and the longer one holds what the
// shorter leaves over, so the value is linear in both and texture units may interpolate the codes.
#include <algorithm>

#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

constexpr float kSteps = 65535.0f;

void encode_multi8(const Image& image, EncodedImage& out) {
  const std::size_t n = image.stride(), plane = image.data.size();
  for (std::size_t i = 0; i < plane; ++i) {
    const float v = std::min(1.0f, texels::clean_positive(image.data[i]) * out.gain[i % n]);
    const long code = std::lround(v * kSteps);
    out.data[i] = static_cast<std::byte>(code >> 8);
    out.data[plane + i] = static_cast<std::byte>(code & 255);
  }
}

void decode_multi8(const EncodedImage& in, int first, int rows, float* out) {
  const auto n = static_cast<std::size_t>(in.channels), row = n * static_cast<std::size_t>(in.width);
  const std::size_t plane = row * static_cast<std::size_t>(in.height);
  const std::byte* from = &in.data[static_cast<std::size_t>(first) * row];
  for (std::size_t i = 0; i < row * static_cast<std::size_t>(rows); ++i) {
    const int code = std::to_integer<int>(from[i]) << 8 | std::to_integer<int>(from[plane + i]);
    out[i] = static_cast<float>(code) / (kSteps * in.gain[i % n]);
  }
}

constexpr std::string_view kGlsl =
#include "encode/multi8.glsl.h"
    ;

}  // namespace

constexpr Encoding kEncodingMulti8{
    .name = "multi8",
    .doc = "two 8-bit exposures 256 apart, linear: 1 % over 1:1310; 6 bytes per texel",
    .max_relative_error = 0.01,
    .smallest = 50.0f / kSteps,
    .largest = 1,
    .is_signed = false,
    .per_channel = true,
    .filters = false,  // linear, but texture units may round interpolated 8-bit channels to 8 bits
    .has_gain = true,
    .type = TexelType::u8,
    .stored_channels = 0,
    .planes = 2,
    .glsl = kGlsl,
    .encode = encode_multi8,
    .decode = decode_multi8,
};

}  // namespace sconce
