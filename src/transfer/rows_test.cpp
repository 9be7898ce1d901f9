// SPDX-License-Identifier: Apache-2.0
// Compressed rows against dense ones; numbers refer to the analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include <numeric>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "transfer/flatten.h"
#include "transfer/quantise.h"
#include "transfer/wavelet_rows.h"

namespace sconce {
namespace {

constexpr uint32_t kColumns = 1024, kRows = 40;

/// Row r: a smooth bump, as a receiver's view of a cloud is, on a third of the columns.
std::vector<SparseEntry> row(uint32_t r) {
  std::vector<SparseEntry> entries;
  for (uint32_t c = r % 3; c < kColumns; c += 3) {
    const float d = (static_cast<float>(c) - 20.0f * static_cast<float>(r)) / 150;
    entries.push_back({c, std::exp(-d * d) / kColumns});
  }
  return entries;
}

/// Light with an edge, as a spot's.
std::vector<Rgbx> light(uint32_t seed) {
  std::vector<Rgbx> v(kColumns);
  const uint32_t from = 97 * seed % 700;
  for (uint32_t c = 0; c < kColumns; ++c)
    if (c >= from && c < from + 300) v[c] = {1, 0.5f + static_cast<float>(c) / 2048, 0.25f, 0};
  return v;
}

WaveletRowsBuilder::Result compress(std::size_t coefficients, Weighting weighting) {
  WaveletRowsBuilder builder(kRows, kColumns, coefficients, squared_weights(kColumns, weighting));
  parallel_for(builder.blocks(), 1, [&](std::size_t block) {
    WaveletRowsBuilder::Scratch scratch(builder);
    std::vector<std::vector<SparseEntry>> rows;
    for (std::size_t r = 16 * block; r < std::min<std::size_t>(kRows, 16 * block + 16); ++r)
      rows.push_back(row(static_cast<uint32_t>(r)));
    builder.set_block(block, rows, scratch);
  });
  return builder.finish();
}

std::vector<Rgb> product(const WaveletRows& rows, std::vector<Rgbx> squares) {
  haar_forward(squares);
  std::vector<Rgb> out(rows.rows);
  multiply(rows, squares, out);
  return out;
}

std::vector<Rgb> exact(const std::vector<Rgbx>& squares) {
  std::vector<Rgb> out(kRows);
  for (uint32_t r = 0; r < kRows; ++r)
    for (const SparseEntry& e : row(r))
      out[r] += e.value * Rgb(squares[e.index][0], squares[e.index][1], squares[e.index][2]);
  return out;
}

double error(std::size_t coefficients, Weighting weighting) {
  double squares = 0;
  const auto made = compress(coefficients, weighting);
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const std::vector<Rgb> a = product(made.rows, light(seed)), b = exact(light(seed));
    for (uint32_t r = 0; r < kRows; ++r) squares += std::pow(static_cast<double>(a[r].g - b[r].g), 2);
  }
  return squares;
}

// 23. Within the step between two codes, half of it: errors of square roots below 1/254.
TEST(Quantise, HalfAStep) {
  for (int i = -1000; i <= 1000; ++i) {
    const float v = 0.002f * static_cast<float>(i), scale = 2;
    const float back = dequantise(quantise(v, scale), scale);
    const float half = 1.0f / 254, root = std::sqrt(std::abs(v) / scale);
    EXPECT_LE(std::abs(back - v), scale * half * (2 * root + half) + 1e-6f) << v;
  }
  for (int c = -127; c <= 127; ++c) EXPECT_EQ(quantise(dequantise(static_cast<int8_t>(c), 0.7f), 0.7f), c);
  EXPECT_EQ(quantise(0.5f, 0), 0);
}

// 22. With all coefficients only quantisation is left; it is exact for even light, whose sum is the mean's.
TEST(WaveletRows, AllCoefficientsAreTheMatrix) {
  const auto made = compress(kColumns, Weighting::root_area);
  EXPECT_EQ(made.rows.indices.size(), made.rows.blocks() * (kColumns - 1)) << "all columns have some row";
  const std::vector<Rgb> a = product(made.rows, light(1)), b = exact(light(1));
  for (uint32_t r = 0; r < kRows; ++r) EXPECT_NEAR(a[r].g, b[r].g, 0.01f * b[r].max() + 2e-4f) << r;
  const std::vector<Rgbx> even(kColumns, Rgbx{2, 1, 0.5f, 0});
  const std::vector<Rgb> c = product(compress(4, Weighting::area).rows, even), d = exact(even);
  for (uint32_t r = 0; r < kRows; ++r) EXPECT_NEAR(c[r].r, d[r].r, 1e-5f * d[r].r);
}

TEST(WaveletRows, MoreCoefficientsAreNoWorse) {
  double before = error(4, Weighting::root_area);
  for (const std::size_t count : {8, 16, 32, 64, 256}) {
    const double now = error(count, Weighting::root_area);
    EXPECT_LT(now, before) << count;
    before = now;
  }
}

// 5. T(a g + b h) = a T g + b T h
TEST(WaveletRows, Superposition) {
  const auto made = compress(40, Weighting::root_area);
  std::vector<Rgbx> both = light(1);
  const std::vector<Rgbx> other = light(4);
  for (std::size_t i = 0; i < both.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) both[i][c] = 2 * both[i][c] + 3 * other[i][c];
  const std::vector<Rgb> sum = product(made.rows, both), a = product(made.rows, light(1)),
                         b = product(made.rows, other);
  for (uint32_t r = 0; r < kRows; ++r) {
    const Rgb expected = 2.0f * a[r] + 3.0f * b[r];
    EXPECT_NEAR(sum[r].r, expected.r, 1e-5f * std::abs(expected.r) + 1e-6f);
    EXPECT_NEAR(sum[r].b, expected.b, 1e-5f * std::abs(expected.b) + 1e-6f);
  }
}

TEST(WaveletRows, SameBitsAtAnyNumberOfThreads) {
  std::vector<Rgb> results[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results[threads - 1] = product(compress(30, Weighting::none).rows, light(2));
  }
  EXPECT_EQ(results[0], results[1]);
}

/// Points all over the walls of a box.
std::vector<SurfacePoint> wall_points(uint32_t n) {
  std::vector<SurfacePoint> points;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec2 u = sobol_pair(i, 0, 7);
    const int axis = static_cast<int>(mix32(i) % 3);
    const float side = (mix32(i) >> 8) % 2 == 0 ? 0.0f : 1.0f;
    SurfacePoint p;
    p.position[axis] = side, p.position[(axis + 1) % 3] = u.x, p.position[(axis + 2) % 3] = u.y;
    p.geometric_normal = Vec3(0);
    p.geometric_normal[axis] = 1 - 2 * side;
    p.shading_normal = p.geometric_normal;
    points.push_back(p);
  }
  return points;
}

double spread(std::span<const SurfacePoint> points, std::span<const uint32_t> order, std::size_t block) {
  double sum = 0;
  for (std::size_t first = 0; first < order.size(); first += block)
    for (std::size_t k = 1; k < block; ++k) {
      const SurfacePoint &a = points[order[first]], &b = points[order[first + k]];
      const Vec3 p = 20.0f * (a.position - b.position), n = 16 * 1.7f * (a.shading_normal - b.shading_normal);
      sum += static_cast<double>(glm::dot(p, p) + glm::dot(n, n)) / static_cast<double>(block - 1);
    }
  return sum;
}

// 8. A permutation whose blocks are the more alike, the smaller they are, and more than those of a random
// one.
TEST(Flatten, BlocksAreAlike) {
  const std::vector<SurfacePoint> points = wall_points(1024);
  const std::vector<uint32_t> order = cluster_order(points, 1, 1.7f);
  std::vector<uint32_t> sorted = order, none(points.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(none.begin(), none.end(), 0u);
  EXPECT_EQ(sorted, none);
  double before = 1e30;
  for (const std::size_t block : {1024, 256, 64, 16, 4}) {
    const double now = spread(points, order, block) / (1024.0 / static_cast<double>(block));
    EXPECT_LT(now, before) << block;
    if (block < 1024) {
      EXPECT_LT(now, 0.7 * spread(points, none, block) / (1024.0 / static_cast<double>(block)));
    }
    before = now;
  }
}

TEST(Flatten, LeavesOfSixteen) {
  const std::vector<SurfacePoint> points = wall_points(1000);
  std::vector<uint32_t> order = cluster_order(points, 16, 1.7f);
  double within = 0;
  for (std::size_t first = 0; first + 16 <= 1000; first += 16)
    for (std::size_t k = 1; k < 16; ++k)
      within += static_cast<double>(
          glm::distance(points[order[first]].position, points[order[first + k]].position));
  EXPECT_LT(within / 1000, 0.2);
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

}  // namespace
}  // namespace sconce
