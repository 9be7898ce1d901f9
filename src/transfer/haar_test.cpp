// SPDX-License-Identifier: Apache-2.0
// 21. of the analytic tests in docs/methods.md.
#include "transfer/haar.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/sobol.h"

namespace sconce {
namespace {

std::vector<float> noise(std::size_t n, uint32_t seed) {
  std::vector<float> v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = sobol_pair(static_cast<uint32_t>(i), 0, seed).x - 0.4f;
  return v;
}

TEST(Haar, MortonIsAPermutationOfTheSquare) {
  EXPECT_EQ(morton(1, 0), 1u);
  EXPECT_EQ(morton(0, 1), 2u);
  EXPECT_EQ(morton(255, 255), 65535u);
  std::vector<int> seen(256, 0);
  for (uint32_t y = 0; y < 16; ++y)
    for (uint32_t x = 0; x < 16; ++x) ++seen[morton(x, y)];
  for (const int n : seen) EXPECT_EQ(n, 1);
}

TEST(Haar, KeepsTheNormAndInverts) {
  const std::vector<float> before = noise(4096, 1);
  std::vector<float> v = before;
  haar_forward(v);
  double a = 0, b = 0;
  for (std::size_t i = 0; i < v.size(); ++i) a += before[i] * before[i], b += v[i] * v[i];
  EXPECT_NEAR(b, a, 1e-6 * a);
  haar_inverse(v);
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], before[i], 1e-6);
}

TEST(Haar, FourChannelsAreFourSquares) {
  std::vector<Rgbx> both(64);
  std::vector<float> one[4];
  for (std::size_t c = 0; c < 4; ++c) {
    one[c] = noise(64, static_cast<uint32_t>(c));
    for (std::size_t i = 0; i < 64; ++i) both[i][c] = one[c][i];
    haar_forward(one[c]);
  }
  haar_forward(both);
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(both[i][c], one[c][i]);
  haar_inverse(both);
  EXPECT_NEAR(both[5][2], noise(64, 2)[5], 1e-6);
}

TEST(Haar, AConstantIsOneCoefficient) {
  std::vector<float> v(1024, 3.0f);
  haar_forward(v);
  EXPECT_FLOAT_EQ(v[0], 32 * 3);
  for (std::size_t i = 1; i < v.size(); ++i) EXPECT_EQ(v[i], 0);
}

TEST(Haar, WaveletsHaveTheirSupport) {
  for (uint32_t i = 0; i < 256; ++i) {
    std::vector<float> v(256, 0.0f);
    v[i] = 1;
    haar_inverse(v);
    EXPECT_EQ(std::count_if(v.begin(), v.end(), [](float x) { return x != 0; }), haar_support(i, 256)) << i;
  }
}

// d_x at (x + h, y), d_y at (x, y + h): a step along x has no d_y.
TEST(Haar, DirectionsLieInTheirQuadrants) {
  std::vector<float> step(16);
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 4; ++x) step[morton(x, y)] = x < 2 ? 1.0f : 0.0f;
  haar_forward(step);
  EXPECT_FLOAT_EQ(step[morton(1, 0)], 2);
  EXPECT_EQ(step[morton(0, 1)], 0);
  EXPECT_EQ(step[morton(1, 1)], 0);
}

TEST(Haar, SparseIsDense) {
  std::vector<float> dense(1024, 0.0f);
  std::vector<SparseEntry> entries, out;
  for (uint32_t i = 0; i < 1024; i += 1 + i % 37) {
    dense[i] = 1.0f + static_cast<float>(i % 5);
    entries.push_back({i, dense[i]});
  }
  haar_forward(dense);
  haar_forward(entries, 1024, out);
  std::vector<float> scattered(1024, 0.0f);
  for (const SparseEntry& e : out) scattered[e.index] = e.value;
  EXPECT_EQ(scattered, dense);
}

/// Listing 9-4 as printed: averages are not copied back, so that every level reads the picture again.
std::vector<double> printed_listing(const std::vector<double>& a, int n) {
  std::vector<double> b(a.size(), 0.0);
  const auto at = [n](int i, int j) { return static_cast<std::size_t>(i * n + j); };
  for (int side = n; side >= 2; side /= 2)
    for (int i = 0; i < side; i += 2)
      for (int j = 0; j < side; j += 2) {
        const double p = a[at(i, j)], q = a[at(i + 1, j)], r = a[at(i, j + 1)], s = a[at(i + 1, j + 1)];
        b[at(i / 2, j / 2)] = 0.5 * (p + q + r + s);
        b[at(i / 2, j / 2 + side / 2)] = 0.5 * (p - q + r - s);
        b[at(i / 2 + side / 2, j / 2)] = 0.5 * (p + q - r - s);
        b[at(i / 2 + side / 2, j / 2 + side / 2)] = 0.5 * (p - q - r + s);
      }
  return b;
}

TEST(Haar, ThePrintedListingLosesWhatOursKeeps) {
  Eigen::MatrixXd printed(256, 256), ours(256, 256);
  for (int i = 0; i < 256; ++i) {
    std::vector<double> unit(256, 0.0);
    unit[static_cast<std::size_t>(i)] = 1;
    const std::vector<double> image = printed_listing(unit, 16);
    std::vector<float> square(256, 0.0f);
    square[static_cast<std::size_t>(i)] = 1;
    haar_forward(square);
    for (int k = 0; k < 256; ++k) {
      printed(k, i) = image[static_cast<std::size_t>(k)];
      ours(k, i) = static_cast<double>(square[static_cast<std::size_t>(k)]);
    }
  }
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(printed).rank(), 193);
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(ours).rank(), 256);
  EXPECT_LT((ours * ours.transpose() - Eigen::MatrixXd::Identity(256, 256)).norm(), 1e-12);
}

}  // namespace
}  // namespace sconce
