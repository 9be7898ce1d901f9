// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set (Highway's foreach_target); the best one that the processor has is
// called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mix/weigh.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.
#include <hwy/highway.h>

#include <cstring>
#include <vector>

#include "mix/weigh.h"

HWY_BEFORE_NAMESPACE();
namespace sconce::HWY_NAMESPACE {

// Unnamed: other files have functions of the same names for the same targets.
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<uint8_t, Ints>;
using V = hn::Vec<Floats>;

inline V look_up(const std::array<float, 256>& table, hn::Vec<Ints> code) {
  return hn::GatherIndex(Floats(), table.data(), code);
}

/// A vector of single channels at gain 1, from the i-th on.
struct Load32 {
  const float* at;
  V operator()(std::size_t i) const { return hn::LoadU(Floats(), at + i); }
};
struct Load16 {
  const hwy::float16_t* at;
  V operator()(std::size_t i) const {
    return hn::PromoteTo(Floats(), hn::LoadU(hn::Rebind<hwy::float16_t, Floats>(), at + i));
  }
};
struct LoadTable {
  const uint8_t* at;
  const WeighTables& tables;
  V operator()(std::size_t i) const {
    return look_up(tables.value, hn::PromoteTo(Ints(), hn::LoadU(Bytes(), at + i)));
  }
};
struct LoadPair {
  const uint8_t *high, *low;
  const WeighTables& tables;
  V operator()(std::size_t i) const {
    const auto value = [](const uint8_t* at) {
      return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), hn::LoadU(Bytes(), at)));
    };
    return hn::Add(hn::Mul(value(high + i), hn::Set(Floats(), tables.value[1])),
                   hn::Mul(value(low + i), hn::Set(Floats(), tables.low[1])));
  }
};

/// Interleaved colours; weights repeat every three values, so three vectors hold whole repetitions.
template <class Load>
void add_colours(const Load& load, std::size_t texels, const Rgb& weight, float* sum) {
  const Floats d;
  const std::size_t n = hn::Lanes(d);
  HWY_ALIGN float pattern[3 * hn::MaxLanes(Floats())];
  for (std::size_t i = 0; i < 3 * n; ++i)
    pattern[i] = i % 3 == 0 ? weight.r : i % 3 == 1 ? weight.g : weight.b;
  const V w[] = {hn::Load(d, pattern), hn::Load(d, pattern + n), hn::Load(d, pattern + 2 * n)};
  for (std::size_t i = 0; i < 3 * texels; i += 3 * n)
    for (std::size_t k = 0; k < 3; ++k) {
      float* to = sum + i + k * n;
      hn::StoreU(hn::Add(hn::LoadU(d, to), hn::Mul(w[k], load(i + k * n))), d, to);
    }
}

/// Interleaved luminances of 1 to 4 groups.
template <class Load>
void add_luminances(const Load& load, std::size_t texels, std::span<const Rgb> weights, float* sum) {
  const Floats d;
  const std::size_t n = hn::Lanes(d), channels = weights.size();
  HWY_ALIGN float values[4 * hn::MaxLanes(Floats())];
  for (std::size_t i = 0; i < texels; i += n) {
    for (std::size_t c = 0; c < channels; ++c) hn::Store(load(i * channels + c * n), d, values + c * n);
    V y[4] = {hn::Load(d, values), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    if (channels == 2) hn::LoadInterleaved2(d, values, y[0], y[1]);
    if (channels == 3) hn::LoadInterleaved3(d, values, y[0], y[1], y[2]);
    if (channels == 4) hn::LoadInterleaved4(d, values, y[0], y[1], y[2], y[3]);
    V r, g, b;
    hn::LoadInterleaved3(d, sum + 3 * i, r, g, b);
    for (std::size_t c = 0; c < channels; ++c) {
      r = hn::Add(r, hn::Mul(hn::Set(d, weights[c].r), y[c]));
      g = hn::Add(g, hn::Mul(hn::Set(d, weights[c].g), y[c]));
      b = hn::Add(b, hn::Mul(hn::Set(d, weights[c].b), y[c]));
    }
    hn::StoreInterleaved3(r, g, b, d, sum + 3 * i);
  }
}

/// Three mantissas and an exponent in four bytes.
void add_shared(const uint8_t* codes, const WeighTables& tables, std::size_t texels, const Rgb& weight,
                float* sum) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> u;
  const auto byte = hn::Set(u, 255u);
  for (std::size_t i = 0; i < texels; i += hn::Lanes(d)) {
    const auto code = hn::LoadU(u, reinterpret_cast<const uint32_t*>(codes + 4 * i));
    const auto value = [&](auto bits) {
      return look_up(tables.value, hn::BitCast(Ints(), hn::And(bits, byte)));
    };
    const V power = look_up(tables.low, hn::BitCast(Ints(), hn::ShiftRight<24>(code)));
    V r, g, b;
    hn::LoadInterleaved3(d, sum + 3 * i, r, g, b);
    r = hn::Add(r, hn::Mul(hn::Set(d, weight.r), hn::Mul(value(code), power)));
    g = hn::Add(g, hn::Mul(hn::Set(d, weight.g), hn::Mul(value(hn::ShiftRight<8>(code)), power)));
    b = hn::Add(b, hn::Mul(hn::Set(d, weight.b), hn::Mul(value(hn::ShiftRight<16>(code)), power)));
    hn::StoreInterleaved3(r, g, b, d, sum + 3 * i);
  }
}

/// @param planes   the first texel's codes in each plane
/// @param texels   whole vectors of them
/// @param weights  gains divided out
void add_vectors(const WeighTables& tables, std::span<const std::byte* const> planes, std::size_t texels,
                 std::span<const Rgb> weights, bool luminance, float* sum) {
  const auto add = [&](const auto& load) {
    luminance ? add_luminances(load, texels, weights, sum) : add_colours(load, texels, weights[0], sum);
  };
  const auto* bytes = reinterpret_cast<const uint8_t*>(planes[0]);
  switch (tables.kind) {
    case WeighTables::Kind::f32:
      return add(Load32{reinterpret_cast<const float*>(bytes)});
    case WeighTables::Kind::f16:
      return add(Load16{reinterpret_cast<const hwy::float16_t*>(bytes)});
    case WeighTables::Kind::table:
      return add(LoadTable{bytes, tables});
    case WeighTables::Kind::pair:
      return add(LoadPair{bytes, reinterpret_cast<const uint8_t*>(planes[1]), tables});
    case WeighTables::Kind::shared:
      return add_shared(bytes, tables, texels, weights[0], sum);
    case WeighTables::Kind::none:
      break;
  }
}

std::size_t lanes() {
  return hn::Lanes(Floats());
}

}  // namespace
}  // namespace sconce::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sconce {

HWY_EXPORT(add_vectors);
HWY_EXPORT(lanes);

void add_weighted(const WeighTables& tables, const EncodedImage& texture, int first, int rows,
                  std::span<const Rgb> weights, bool luminance, float* sum) {
  const auto width = static_cast<std::size_t>(texture.width), texels = width * static_cast<std::size_t>(rows);
  std::array<Rgb, 4> scaled;
  for (std::size_t c = 0; c < weights.size(); ++c) scaled[c] = weights[c] / texture.gain[c];

  const auto count = static_cast<std::size_t>(texture.encoding->planes);
  const std::size_t plane = texture.data.size() / count;
  const std::size_t texel_bytes = plane / (width * static_cast<std::size_t>(texture.height));
  std::array<const std::byte*, 2> planes{};
  for (std::size_t p = 0; p < count; ++p)
    planes[p] = texture.data.data() + p * plane + static_cast<std::size_t>(first) * width * texel_bytes;

  const std::size_t vector = HWY_DYNAMIC_DISPATCH(lanes)(), rest = texels % vector, whole = texels - rest;
  const auto add = [&](const std::array<const std::byte*, 2>& at, std::size_t n, float* to) {
    HWY_DYNAMIC_DISPATCH(add_vectors)
    (tables, {at.data(), count}, n, {scaled.data(), weights.size()}, luminance, to);
  };
  if (whole > 0) add(planes, whole, sum);
  if (rest == 0) return;
  // The last texels go through copies as long as a vector.
  std::array<std::vector<std::byte>, 2> codes;
  std::array<const std::byte*, 2> at{};
  for (std::size_t p = 0; p < count; ++p) {
    codes[p].resize(vector * texel_bytes);
    std::memcpy(codes[p].data(), planes[p] + whole * texel_bytes, rest * texel_bytes);
    at[p] = codes[p].data();
  }
  std::vector<float> tail(3 * vector);
  std::copy_n(sum + 3 * whole, 3 * rest, tail.begin());
  add(at, vector, tail.data());
  std::copy_n(tail.begin(), 3 * rest, sum + 3 * whole);
}

}  // namespace sconce
#endif
