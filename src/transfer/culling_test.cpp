// SPDX-License-Identifier: Apache-2.0
// 23. of the analytic tests in docs/methods.md, with erratum C6: what culling changes is within its bound.
#include "transfer/culling.h"

#include <gtest/gtest.h>

#include "transfer/folded_bounces.h"
#include "transfer/test_operator.h"

namespace sconce {
namespace {

constexpr uint32_t kSlots = 1024;

Operator made_up(uint32_t receivers) {
  return made_up_operator({.receivers = receivers,
                           .slots = kSlots,
                           .cluster = 64,
                           .first_cluster = 64,
                           .node_cluster = 256,
                           .coefficients = 128,
                           .bounce_coefficients = 64});
}

Operator made_up_plain() {
  return made_up_operator(
      {.receivers = 1008, .slots = kSlots, .plain = true, .cluster = 16, .first_cluster = 16});
}

/// Light with an edge, as a spot's.
std::vector<Rgbx> spot(uint32_t seed) {
  std::vector<Rgbx> v(kSlots, Rgbx{});
  const uint32_t from = 97 * seed % 700;
  for (uint32_t c = from; c < from + 150; ++c) v[c] = {1, 0.5f + static_cast<float>(c) / 2048, 0.25f, 0};
  haar_forward(v);
  return v;
}

std::vector<Rgb> product(const ClusterRows& rows, const std::vector<Rgbx>& light,
                         Zeros zeros = Zeros::multiply) {
  std::vector<Rgb> out(rows.rows);
  multiply(rows, light, out, zeros);
  return out;
}

double difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const float d : {a[i].r - b[i].r, a[i].g - b[i].g, a[i].b - b[i].b})
      squares += static_cast<double>(d) * static_cast<double>(d);
  return std::sqrt(squares);
}

// One coefficient alone changes no more than its norm says, and of plain rows exactly as much.
TEST(Culling, NormsAreOfColumns) {
  for (const Operator& op : {made_up(1000), made_up_plain()}) {
    const Culling culling(op.gather);
    const std::vector<Rgb> none(op.gather.rows);
    double largest = 0;
    for (uint32_t c = 0; c < kSlots; c += 7) {
      std::vector<Rgbx> light(kSlots, Rgbx{});
      light[c] = {1, 0, 0, 0};
      const double change = difference(product(op.gather, light), none), norm = culling.norms()[c];
      EXPECT_LE(change, norm * (1 + 1e-5)) << c;
      if (op.gather.plain()) {
        EXPECT_GE(change, norm * (1 - 1e-5)) << c;
      }
      if (norm > 0) largest = std::max(largest, change / norm);
    }
    EXPECT_GT(largest, 0.3) << "the bound is not idle";
  }
}

TEST(Culling, KeepsItsBound) {
  for (const Operator& op : {made_up(1000), made_up_plain(), made_up(17)}) {
    const Culling culling(op.gather);
    for (uint32_t seed = 0; seed < 10; ++seed) {
      const std::vector<Rgbx> whole = spot(seed);
      std::size_t before = 0;
      for (const float share : {1e-3f, 1e-2f, 0.1f, 1.0f}) {
        std::vector<Rgbx> left = whole;
        const Culling::Report report = culling.apply(share, left);
        EXPECT_LE(difference(product(op.gather, whole), product(op.gather, left)), report.bound * (1 + 1e-4));
        EXPECT_GE(report.culled, before);
        EXPECT_LE(report.culled, report.of);
        EXPECT_EQ(left[0], whole[0]) << "the mean stays";
        before = report.culled;
      }
      EXPECT_GT(before, 50u);
    }
  }
}

// Columns at right angles: the squares of what they do add, and the bound is the error.
TEST(Culling, OfColumnsAtRightAnglesIsTheBound) {
  WaveletRowsBuilder builder(16, kSlots, 17, std::vector<float>(kSlots, 1.0f));
  std::vector<Sixteen> values(kSlots, Sixteen{});
  std::vector<uint32_t> chosen;
  for (std::size_t row = 0; row < 16; ++row) {
    const auto k = static_cast<uint32_t>(3 + 60 * row);
    values[0][row] = 100;
    values[k][row] = 1 + static_cast<float>(row);
    chosen.push_back(k);
  }
  builder.set_block(0, chosen, values);
  const auto made = builder.finish();
  const ClusterRows rows{16, 16, made.rows, {}, {}};
  const std::vector<Rgbx> whole = spot(2);
  std::vector<Rgbx> left = whole;
  const Culling::Report report = Culling(rows).apply(1, left);
  EXPECT_EQ(report.culled, 16u);
  const double error = difference(product(rows, whole), product(rows, left));
  EXPECT_GT(error, 0);
  EXPECT_NEAR(report.bound, error, 1e-4 * error);
}

TEST(Culling, OfNothingIsTheSameBits) {
  const Operator op = made_up(1000);
  const Culling culling(op.gather);
  std::vector<Rgbx> light = spot(3);
  const Culling::Report report = culling.apply(0, light);
  EXPECT_EQ(report.culled, 0u);
  EXPECT_EQ(report.bound, 0);
  EXPECT_EQ(light, spot(3));
  const FoldedBounces bounces(op);
  std::vector<Rgbx> a(kSlots, Rgbx{1, 2, 3, 0}), b = a;
  std::vector<Rgb> all(op.gather.rows), culled(op.gather.rows);
  bounces.indirect(a, all);
  bounces.indirect(b, culled, culling, 0);
  EXPECT_EQ(all, culled);
}

TEST(Culling, PassingOverZerosIsTheSameProduct) {
  const Operator op = made_up(1000);
  std::vector<Rgbx> light = spot(5);
  Culling(op.gather).apply(0.05f, light);
  EXPECT_EQ(product(op.gather, light, Zeros::skip), product(op.gather, light));
}

}  // namespace
}  // namespace sconce
