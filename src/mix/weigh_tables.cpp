// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "mix/weigh.h"

namespace sconce {

namespace {

/// The first channel of one texel, gain 1. @param codes  per plane and stored channel
float value_of(const Encoding& e, std::vector<std::byte> codes) {
  const int channels = e.per_channel ? 1 : 3;
  float out[3];
  e.decode({&e, 1, 1, channels, {1, 1, 1, 1}, std::move(codes)}, 0, 1, out);
  return out[0];
}

}  // namespace

WeighTables::WeighTables(const Encoding& e) {
  constexpr auto kReference = std::byte{200};  // a mantissa and an exponent far from the ends
  const auto code = [](std::size_t i) { return static_cast<std::byte>(i); };
  if (e.type == TexelType::f32) kind = Kind::f32;
  if (e.type == TexelType::f16) kind = Kind::f16;
  if (e.type != TexelType::u8) return;
  if (e.per_channel && e.planes == 1) {
    kind = Kind::table;
    for (std::size_t i = 0; i < 256; ++i) value[i] = value_of(e, {code(i)});
  } else if (e.per_channel && e.planes == 2) {
    kind = Kind::pair;
    value[1] = value_of(e, {code(1), code(0)});
    low[1] = value_of(e, {code(0), code(1)});
  } else if (e.stored_channels == 4) {
    kind = Kind::shared;
    // At exponent 128 + 8 or so mantissas are ordinary numbers; exponents are then powers of two beside it.
    const float unit = value_of(e, {kReference, kReference, kReference, std::byte{130}});
    for (std::size_t i = 0; i < 256; ++i) {
      value[i] = value_of(e, {code(i), code(i), code(i), std::byte{130}});
      low[i] = value_of(e, {kReference, kReference, kReference, code(i)}) / unit;
    }
  }
}

void add_weighted_plain(const EncodedImage& texture, int first, int rows, std::span<const Rgb> weights,
                        bool luminance, float* sum) {
  const auto n = static_cast<std::size_t>(texture.channels);
  const std::size_t count = static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(rows);
  std::vector<float> values(count * n);
  texture.encoding->decode(texture, first, rows, values.data());
  for (std::size_t i = 0; i < count; ++i, sum += 3) {
    const float* v = &values[i * n];
    if (!luminance) {
      sum[0] += weights[0].r * v[0], sum[1] += weights[0].g * v[1], sum[2] += weights[0].b * v[2];
      continue;
    }
    for (std::size_t c = 0; c < n; ++c)
      sum[0] += weights[c].r * v[c], sum[1] += weights[c].g * v[c], sum[2] += weights[c].b * v[c];
  }
}

}  // namespace sconce
