// SPDX-License-Identifier: Apache-2.0
// Loops that the encodings share.
#pragma once

#include <cmath>
#include <cstring>

#include "encode/encoding.h"

namespace sconce::texels {

/// A value as encodings want it: NaN is 0.
inline float clean(float v) {
  return std::isnan(v) ? 0.0f : v;
}
/// For unsigned ones: negative is 0, too.
inline float clean_positive(float v) {
  return v > 0 ? v : 0.0f;
}

/// Every channel alone to one code of type Code.
/// @param f  (value, gain) -> Code
template <class Code, class F>
void encode_channels(const Image& image, EncodedImage& out, F f) {
  const std::size_t n = image.stride();
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const Code code = f(image.data[i], out.gain[i % n]);
    std::memcpy(&out.data[i * sizeof(Code)], &code, sizeof(Code));
  }
}
/// @param f  (Code, gain) -> value
template <class Code, class F>
void decode_channels(const EncodedImage& in, int first, int rows, float* out, F f) {
  const auto n = static_cast<std::size_t>(in.channels), row = n * static_cast<std::size_t>(in.width);
  const std::byte* from = &in.data[static_cast<std::size_t>(first) * row * sizeof(Code)];
  for (std::size_t i = 0; i < row * static_cast<std::size_t>(rows); ++i) {
    Code code;
    std::memcpy(&code, from + i * sizeof(Code), sizeof(Code));
    out[i] = f(code, in.gain[i % n]);
  }
}

/// R, G, B to four bytes.
/// @param f  (const float* rgb, unsigned char* bytes)
template <class F>
void encode_rgb(const Image& image, EncodedImage& out, F f) {
  auto* bytes = reinterpret_cast<unsigned char*>(out.data.data());
  for (std::size_t i = 0; i < image.pixels(); ++i) f(&image.data[3 * i], bytes + 4 * i);
}
/// @param f  (const unsigned char* bytes, float* rgb)
template <class F>
void decode_rgb(const EncodedImage& in, int first, int rows, float* out, F f) {
  const auto width = static_cast<std::size_t>(in.width);
  const auto* bytes =
      reinterpret_cast<const unsigned char*>(in.data.data()) + 4 * width * static_cast<std::size_t>(first);
  for (std::size_t i = 0; i < width * static_cast<std::size_t>(rows); ++i) f(bytes + 4 * i, out + 3 * i);
}

}  // namespace sconce::texels
