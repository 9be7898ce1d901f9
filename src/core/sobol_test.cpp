// SPDX-License-Identifier: Apache-2.0
#include "core/sobol.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace sconce {
namespace {

// Sobol' 1967: direction numbers of dimension 2 are v_0 = 1/2, v_{k+1} = v_k xor (v_k / 2).
uint32_t sobol1(uint32_t i) {
  uint32_t result = 0;
  for (uint32_t v = 1u << 31; i != 0; i >>= 1, v ^= v >> 1)
    if (i & 1) result ^= v;
  return result;
}

TEST(Sobol, SecondDimensionIsPascalsTriangleModuloTwo) {
  for (uint32_t i = 0; i < 100000; i += 7)
    EXPECT_EQ(detail::reverse_bits(detail::sobol1_reversed(i)), sobol1(i)) << i;
  EXPECT_EQ(detail::reverse_bits(detail::sobol1_reversed(0xffffffffu)), sobol1(0xffffffffu));
}

TEST(Sobol, EveryPairIsAZeroTwoSequence) {
  // Any 2^m consecutive points put exactly one into each elementary interval of area 2^-m.
  for (uint32_t pair : {0u, 1u, 77u})
    for (uint32_t stream : {5u, 123456u})
      for (uint32_t first : {0u, 64u, 192u})
        for (uint32_t log_x = 0; log_x <= 6; ++log_x) {
          std::set<std::pair<uint32_t, uint32_t>> cells;
          for (uint32_t i = 0; i < 64; ++i) {
            const Vec2 p = sobol_pair(first + i, pair, stream);
            cells.insert({static_cast<uint32_t>(p.x * static_cast<float>(1u << log_x)),
                          static_cast<uint32_t>(p.y * static_cast<float>(1u << (6 - log_x)))});
          }
          EXPECT_EQ(cells.size(), 64u) << "pair " << pair << ", 2^" << log_x << " columns";
        }
}

TEST(Sobol, PairsAndStreamsAreUncorrelated) {
  // Covariance of independent uniforms over n points is 0 with standard deviation 1 / (12 sqrt n) = 0.0013.
  const int n = 4096;
  double covariance = 0;
  for (uint32_t i = 0; i < n; ++i)
    covariance += (static_cast<double>(sobol_pair(i, 0, 9).x) - 0.5) *
                  (static_cast<double>(sobol_pair(i, 1, 9).x) - 0.5);
  EXPECT_NEAR(covariance / n, 0, 0.006);
}

TEST(Sobol, IntegratesASmoothFunctionFarBetterThanChance) {
  // int x y = 1/4; 1024 random points err by about 0.007.
  double sum = 0;
  for (uint32_t i = 0; i < 1024; ++i) {
    const Vec2 p = sobol_pair(i, 3, 42);
    sum += static_cast<double>(p.x) * static_cast<double>(p.y);
  }
  EXPECT_NEAR(sum / 1024, 0.25, 2e-4);
}

}  // namespace
}  // namespace sconce
