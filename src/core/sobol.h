// SPDX-License-Identifier: Apache-2.0
// Owen-scrambled Sobol points in padded pairs: every pair of dimensions is the (0,2)-sequence of the first
// two Sobol dimensions, its index shuffled and its digits scrambled by a hash of (seed, receiver, pair).
// Source: Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).
#pragma once

#include <bit>
#include <cstdint>

#include "core/hash.h"
#include "core/vec.h"

namespace sconce {

namespace detail {
constexpr uint32_t reverse_bits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// Laine-Karras style permutation on bit-reversed digits (constants by Vegdahl).
constexpr uint32_t owen_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Second Sobol dimension, bit-reversed (so that it can be scrambled at once).
constexpr uint32_t sobol1_reversed(uint32_t i) {
  // Column k of the reversed generator matrix is row k of Pascal's triangle modulo 2.
  uint32_t x = i;
  x ^= (x & 0xaaaaaaaau) >> 1;
  x ^= (x & 0xccccccccu) >> 2;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xff00ff00u) >> 8;
  x ^= (x & 0xffff0000u) >> 16;
  return x;
}

/// 24 bits into [0, 1): never 1, exact in float.
constexpr float to_unit(uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}
}  // namespace detail

/// A pair as 32-bit fractions. A further XOR with any constants is again a (0,2)-sequence.
struct SobolBits {
  uint32_t x, y;

  Vec2 unit() const { return {detail::to_unit(x), detail::to_unit(y)}; }
  /// Scrambled once more, as a sequence of its own for `key`.
  SobolBits scrambled(uint32_t key) const {
    const uint32_t h = mix32(key);
    return {x ^ h, y ^ (h * 0x9e3779b1u)};
  }
};

/// As sobol_pair, for a caller that asks for many pairs of one point: `reversed` =
/// detail::reverse_bits(index).
inline SobolBits sobol_bits(uint32_t reversed, uint32_t pair, uint32_t stream) {
  const uint32_t key = mix32(stream ^ (pair * 0x9e3779b9u));
  const uint32_t shuffled = detail::reverse_bits(detail::owen_reversed(reversed, key));
  const uint32_t x = detail::owen_reversed(shuffled, mix32(key + 1));
  const uint32_t y = detail::owen_reversed(detail::sobol1_reversed(shuffled), mix32(key + 2));
  return {detail::reverse_bits(x), detail::reverse_bits(y)};
}

/// Pair `pair` of point `index` of the sequence that (seed, receiver) name. Pure; any order of calls.
inline Vec2 sobol_pair(uint32_t index, uint32_t pair, uint32_t stream) {
  return sobol_bits(detail::reverse_bits(index), pair, stream).unit();
}

/// The pairs of one sample, taken in order.
class Sampler {
 public:
  Sampler(uint32_t seed, uint32_t receiver, uint32_t index) : stream_(mix32(receiver, seed)), index_(index) {}
  Vec2 next() { return sobol_pair(index_, pair_++, stream_); }

 private:
  uint32_t stream_, index_, pair_ = 0;
};

}  // namespace sconce
