// SPDX-License-Identifier: Apache-2.0
#include "solve/denoise.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {
namespace {

constexpr float kSpacing = 0.1f;

TexelNode node(const Vec3& position, const Vec3& normal = Vec3(0, 0, 1)) {
  return {position, normal, normal, kSpacing, kSpacing * kSpacing};
}

/// side x side texels of the plane z = 0, row by row.
std::vector<TexelNode> plane(int side) {
  std::vector<TexelNode> nodes;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) nodes.push_back(node(kSpacing * Vec3(x, y, 0)));
  return nodes;
}

TexelGraph open_graph(std::vector<TexelNode> nodes) {
  return TexelGraph(std::move(nodes), [](const Vec3&, const Vec3&) { return false; });
}

/// Standard normal number of texel i: Box and Muller 1958.
float normal_number(uint32_t i, uint32_t seed) {
  const auto unit = [&](uint32_t k) {
    return (static_cast<float>(mix32(mix32(seed, i), k) >> 8) + 0.5f) / 16777216.0f;
  };
  return std::sqrt(-2 * std::log(unit(0))) * std::cos(2 * kPi * unit(1));
}

using Values = std::vector<std::vector<GroupValue>>;

/// One group: truth(i) with noise of standard deviation sigma.
template <class F>
std::vector<GroupValue> noisy(std::size_t count, float sigma, uint32_t seed, const F& truth) {
  std::vector<GroupValue> values;
  for (uint32_t i = 0; i < count; ++i)
    values.push_back({Rgb(truth(i) + sigma * normal_number(i, seed)), sigma});
  return values;
}

double mean_square(const std::vector<GroupValue>& values, const auto& truth) {
  double sum = 0;
  for (uint32_t i = 0; i < values.size(); ++i) {
    const double d = static_cast<double>(values[i].illuminance.g) - static_cast<double>(truth(i));
    sum += d * d;
  }
  return sum / static_cast<double>(values.size());
}

TEST(Denoise, ConstantStaysToTheBit) {
  const TexelGraph graph = open_graph(plane(20));
  const Values values{std::vector<GroupValue>(graph.size(), {Rgb(0.1f, 3.3f, 700), 5})};
  const Values clean = denoise(graph, values);
  for (const GroupValue& v : clean[0]) EXPECT_EQ(v.illuminance, values[0][0].illuminance);
}

TEST(Denoise, WithoutNoiseNothingChanges) {
  const TexelGraph graph = open_graph(plane(20));
  const Values values{noisy(graph.size(), 0, 1, [](uint32_t i) { return static_cast<float>(i % 7); })};
  const Values clean = denoise(graph, values);
  for (std::size_t i = 0; i < graph.size(); ++i) EXPECT_EQ(clean[0][i].illuminance, values[0][i].illuminance);
}

// What linear light mixing rests on. The sum goes in as a third group whose error is so large that it has no
// edges of its own, so the weights are those of the two.
TEST(Denoise, SumsOfGroupsStaySums) {
  const TexelGraph graph = open_graph(plane(24));
  Values values{noisy(graph.size(), 0.3f, 1, [](uint32_t i) { return i % 24 < 12 ? 1.0f : 4.0f; }),
                noisy(graph.size(), 0.1f, 2, [](uint32_t i) { return 0.1f * static_cast<float>(i / 24); }),
                {}};
  for (std::size_t i = 0; i < graph.size(); ++i)
    values[2].push_back({values[0][i].illuminance + values[1][i].illuminance, 1e6f});
  const Values clean = denoise(graph, values);
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float sum = clean[0][i].illuminance.g + clean[1][i].illuminance.g;
      EXPECT_NEAR(clean[2][i].illuminance.g, sum, 1e-5f * std::abs(sum) + 1e-6f);
    }
}

// The last pass reaches 9 spacings with weights (1 - r^2)^2: sum pi 81 / 3, sum of squares pi 81 / 5, so 141
// texels count; guides that follow the noise cost some of them.
TEST(Denoise, WhiteNoiseFalls) {
  const auto truth = [](uint32_t) { return 10.0f; };
  const TexelGraph graph = open_graph(plane(64));
  const Values values{noisy(graph.size(), 1, 3, truth)};
  const Values clean = denoise(graph, values);
  const double left = mean_square(clean[0], truth);
  EXPECT_LT(left, 1.0 / 35);
  EXPECT_GT(left, 1.0 / 90);
  // And it says so.
  double stated = 0;
  for (const GroupValue& v : clean[0]) stated += static_cast<double>(v.error * v.error);
  stated /= static_cast<double>(graph.size());
  EXPECT_LT(left, 2 * stated);
  EXPECT_GT(left, 0.5 * stated);
}

TEST(Denoise, ShadowEdgesOfAnyGroupStay) {
  const int side = 48;
  const auto lit = [&](uint32_t i) { return i % side < 20 ? 10.0f : 2.0f; };
  const auto flat = [](uint32_t) { return 5.0f; };
  const TexelGraph graph = open_graph(plane(side));
  const Values clean =
      denoise(graph, Values{noisy(graph.size(), 0.3f, 4, lit), noisy(graph.size(), 0.3f, 5, flat)});
  for (uint32_t i = 0; i < graph.size(); ++i)
    if (i % side == 19 || i % side == 20) {
      EXPECT_NEAR(clean[0][i].illuminance.g, lit(i), 3 * 0.3f) << i;
      // The same weights: the group without an edge is filtered on one side of it only.
      EXPECT_NEAR(clean[1][i].error, clean[0][i].error, 1e-6f);
    }
  EXPECT_LT(mean_square(clean[0], lit), 0.09 / 15);
}

// The noise of the light is larger than the darkness, but not the noise in the dark.
TEST(Denoise, NoisyLightStaysOutOfTheDark) {
  const int side = 40;
  const TexelGraph graph = open_graph(plane(side));
  std::vector<GroupValue> values;
  for (uint32_t i = 0; i < graph.size(); ++i) {
    const float value = i % side < 20 ? 10.0f : 0.1f, sigma = 0.4f * value;
    values.push_back({Rgb(value + sigma * normal_number(i, 10)), sigma});
  }
  const Values clean = denoise(graph, Values{values});
  double edge = 0;
  for (uint32_t y = 0; y < side; ++y)
    edge += static_cast<double>(clean[0][y * side + 20].illuminance.g) / side;
  EXPECT_NEAR(edge, 0.1, 0.02);
}

// Linear over the plane: weights are centred on the texel as far as they can.
TEST(Denoise, SlopesStay) {
  const int side = 40;
  const auto slope = [&](uint32_t i) {
    return 10 + 0.02f * static_cast<float>(i % side) + 0.01f * static_cast<float>(i / side);
  };
  const TexelGraph graph = open_graph(plane(side));
  const Values clean = denoise(graph, Values{noisy(graph.size(), 0.5f, 6, slope)});
  EXPECT_LT(mean_square(clean[0], slope), 0.25 / 25);
}

// Texels on both faces of a wall 1 mm thick, and the floor on both sides of one that stands on it.
TEST(Denoise, NothingPassesThinWalls) {
  std::vector<TexelNode> nodes = plane(20);
  const std::size_t front = nodes.size();
  for (std::size_t i = 0; i < front; ++i)
    nodes.push_back(node(nodes[i].position - Vec3(0, 0, 0.001f), Vec3(0, 0, -1)));
  const TexelGraph faces = open_graph(nodes);
  for (std::size_t i = 0; i < front; ++i)
    for (const uint32_t j : faces.links(i)) EXPECT_LT(j, front);

  const float wall = 9.5f * kSpacing;
  const TexelGraph floor(plane(20),
                         [&](const Vec3& from, const Vec3& to) { return (from.x < wall) != (to.x < wall); });
  // Noise as large as the difference: only the wall can tell the sides apart.
  const auto truth = [](uint32_t i) { return i % 20 < 10 ? 4.0f : 0.0f; };
  std::vector<GroupValue> values = noisy(floor.size(), 0, 7, truth);
  for (GroupValue& v : values) v.error = 4;
  const Values clean = denoise(floor, Values{values});
  for (uint32_t i = 0; i < floor.size(); ++i) EXPECT_EQ(clean[0][i].illuminance.g, truth(i)) << i;
}

// Two charts of one plane, listed one after the other: what counts is where texels lie.
TEST(Denoise, SeamsBetweenChartsAreNotSeen) {
  const std::vector<TexelNode> whole = plane(20);
  std::vector<TexelNode> cut;
  std::vector<uint32_t> from;
  for (const bool right : {true, false})
    for (uint32_t i = 0; i < whole.size(); ++i)
      if ((i % 20 >= 9) == right) {
        cut.push_back(whole[i]);
        from.push_back(i);
      }
  const auto values = noisy(whole.size(), 1, 8, [](uint32_t) { return 9.0f; });
  std::vector<GroupValue> moved;
  for (const uint32_t i : from) moved.push_back(values[i]);
  const Values a = denoise(open_graph(whole), Values{values}), b = denoise(open_graph(cut), Values{moved});
  for (std::size_t k = 0; k < cut.size(); ++k)
    EXPECT_NEAR(a[0][from[k]].illuminance.g, b[0][k].illuminance.g, 1e-4f);
}

TEST(Denoise, SameBitsAtAnyThreadCount) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    const TexelGraph graph = open_graph(plane(100));
    return denoise(graph, Values{noisy(graph.size(), 1, 9, [](uint32_t i) { return (i / 7) % 3 * 2.0f; })});
  };
  const Values one = run(1), many = run(4);
  for (std::size_t i = 0; i < one[0].size(); ++i) {
    EXPECT_EQ(one[0][i].illuminance, many[0][i].illuminance);
    EXPECT_EQ(one[0][i].error, many[0][i].error);
  }
}

}  // namespace
}  // namespace sconce
