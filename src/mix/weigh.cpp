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

#ifndef SCONCE_MIX_RUN
#define SCONCE_MIX_RUN
namespace sconce {

/// Codes of a texture from some row on.
struct Run {
  const WeighTables* tables;
  std::array<const uint8_t*, 2> planes;
  std::array<Rgb, 4> weights;  ///< gains divided out
  std::size_t groups, texel_bytes;
  bool luminance;

  std::span<const Rgb> used() const { return {weights.data(), groups}; }
  bool goes_with(const Run& other) const {
    return !luminance && !other.luminance && tables->kind == other.tables->kind;
  }
};

/// Textures that one pass over the sum adds: the sum is read and written a quarter as often, and each stream
/// is still foreseen.
inline constexpr std::size_t kTogether = 4;

}  // namespace sconce
#endif

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
  explicit Load32(const Run& run) : at(reinterpret_cast<const float*>(run.planes[0])) {}
  const float* at;
  V operator()(std::size_t i) const { return hn::LoadU(Floats(), at + i); }
};
struct Load16 {
  explicit Load16(const Run& run) : at(reinterpret_cast<const hwy::float16_t*>(run.planes[0])) {}
  const hwy::float16_t* at;
  V operator()(std::size_t i) const {
    return hn::PromoteTo(Floats(), hn::LoadU(hn::Rebind<hwy::float16_t, Floats>(), at + i));
  }
};
struct LoadTable {
  explicit LoadTable(const Run& run) : at(run.planes[0]), tables(*run.tables) {}
  const uint8_t* at;
  const WeighTables& tables;
  V operator()(std::size_t i) const {
    return look_up(tables.value, hn::PromoteTo(Ints(), hn::LoadU(Bytes(), at + i)));
  }
};
struct LoadPair {
  explicit LoadPair(const Run& run) : high(run.planes[0]), low(run.planes[1]), tables(*run.tables) {}
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

/// Interleaved colours of K textures in one pass over the sum; weights repeat every three values, so three
/// vectors hold whole repetitions.
template <class Load, std::size_t K>
void add_colours(const std::array<Load, K>& loads, std::size_t texels, const Run* runs, float* sum) {
  const Floats d;
  const std::size_t n = hn::Lanes(d);
  HWY_ALIGN float pattern[K][3 * hn::MaxLanes(Floats())];
  for (std::size_t t = 0; t < K; ++t)
    for (std::size_t i = 0; i < 3 * n; ++i) {
      const Rgb& weight = runs[t].weights[0];
      pattern[t][i] = i % 3 == 0 ? weight.r : i % 3 == 1 ? weight.g : weight.b;
    }
  for (std::size_t i = 0; i < 3 * texels; i += 3 * n)
    for (std::size_t k = 0; k < 3; ++k) {
      float* to = sum + i + k * n;
      V v = hn::LoadU(d, to);
      for (std::size_t t = 0; t < K; ++t)
        v = hn::Add(v, hn::Mul(hn::Load(d, &pattern[t][k * n]), loads[t](i + k * n)));
      hn::StoreU(v, d, to);
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
void add_shared(const Run& run, std::size_t texels, float* sum) {
  const uint8_t* codes = run.planes[0];
  const WeighTables& tables = *run.tables;
  const Rgb& weight = run.weights[0];
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

template <class Load, std::size_t K>
std::array<Load, K> loads_of(const Run* runs) {
  return [&]<std::size_t... T>(std::index_sequence<T...>) {
    return std::array<Load, K>{Load(runs[T])...};
  }(std::make_index_sequence<K>());
}

/// @param runs    textures of one kind, all of colours or a single one
/// @param texels  whole vectors of them
void add_vectors(std::span<const Run> runs, std::size_t texels, float* sum) {
  const Run& first = runs.front();
  const auto add = [&]<class Load>(std::type_identity<Load>) {
    if (first.luminance) return add_luminances(Load(first), texels, first.used(), sum);
    std::size_t i = 0;
    for (; i + kTogether <= runs.size(); i += kTogether)
      add_colours(loads_of<Load, kTogether>(&runs[i]), texels, &runs[i], sum);
    for (; i < runs.size(); ++i) add_colours(loads_of<Load, 1>(&runs[i]), texels, &runs[i], sum);
  };
  switch (first.tables->kind) {
    case WeighTables::Kind::f32:
      return add(std::type_identity<Load32>());
    case WeighTables::Kind::f16:
      return add(std::type_identity<Load16>());
    case WeighTables::Kind::table:
      return add(std::type_identity<LoadTable>());
    case WeighTables::Kind::pair:
      return add(std::type_identity<LoadPair>());
    case WeighTables::Kind::shared:
      for (const Run& run : runs) add_shared(run, texels, sum);
      return;
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

namespace {

Run run_from(const Weighted& term, int first) {
  const EncodedImage& texture = term.texture;
  Run run{&term.tables, {}, {}, term.weights.size(), 0, term.luminance};
  for (std::size_t c = 0; c < term.weights.size(); ++c) run.weights[c] = term.weights[c] / texture.gain[c];
  const auto count = static_cast<std::size_t>(texture.encoding->planes);
  const auto width = static_cast<std::size_t>(texture.width);
  const std::size_t plane = texture.data.size() / count;
  run.texel_bytes = plane / (width * static_cast<std::size_t>(texture.height));
  for (std::size_t p = 0; p < count; ++p)
    run.planes[p] = reinterpret_cast<const uint8_t*>(texture.data.data()) + p * plane +
                    static_cast<std::size_t>(first) * width * run.texel_bytes;
  return run;
}

}  // namespace

void add_weighted(std::span<const Weighted> terms, int first, int rows, float* sum) {
  if (terms.empty()) return;
  std::vector<Run> runs;
  for (const Weighted& term : terms) runs.push_back(run_from(term, first));
  const std::size_t texels =
      static_cast<std::size_t>(terms.front().texture.width) * static_cast<std::size_t>(rows);
  const std::size_t vector = HWY_DYNAMIC_DISPATCH(lanes)(), rest = texels % vector, whole = texels - rest;
  const auto add = [&](std::size_t n, float* to) {
    for (std::size_t i = 0, next = 0; i < runs.size(); i = next) {
      for (next = i + 1; next < runs.size() && runs[next].goes_with(runs[i]); ++next) continue;
      HWY_DYNAMIC_DISPATCH(add_vectors)({&runs[i], next - i}, n, to);
    }
  };
  if (whole > 0) add(whole, sum);
  if (rest == 0) return;
  // The last texels go through copies as long as a vector.
  std::vector<std::vector<uint8_t>> codes;
  for (Run& run : runs)
    for (const uint8_t*& plane : run.planes) {
      if (!plane) continue;
      codes.emplace_back(vector * run.texel_bytes);
      std::memcpy(codes.back().data(), plane + whole * run.texel_bytes, rest * run.texel_bytes);
      plane = codes.back().data();
    }
  std::vector<float> tail(3 * vector);
  std::copy_n(sum + 3 * whole, 3 * rest, tail.begin());
  add(vector, tail.data());
  std::copy_n(tail.begin(), 3 * rest, sum + 3 * whole);
}

}  // namespace sconce
#endif
