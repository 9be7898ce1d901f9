// SPDX-License-Identifier: Apache-2.0
// Things that move: the rows that saw them are made again, and are as if all had been.
#include "relight/operator_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TransferParams quick() {
  TransferParams params;
  params.gather = 1024, params.rays = 64, params.lights = 48, params.cluster = 64, params.keep_sums = true;
  params.movable = true;
  return params;
}

/// Two rooms with nothing between them, a box in the first.
struct Rooms {
  Scene scene;
  World world;
  Tracer tracer;

  Rooms() : scene(made()), world(make_world(scene)), tracer(scene, world) {}
  static Scene made() {
    Scene scene;
    const auto white = add_material(scene, "white", Rgb(0.7f));
    for (const float x : {0.0f, 10.0f})
      for (int axis = 0; axis < 3; ++axis)
        for (int cell = 0; cell < 32; ++cell) {  // walls of four by four, then those opposite
          Vec3 p(x, 0, 0), a(0), b(0);
          a[(axis + 1) % 3] = b[(axis + 2) % 3] = 0.75f;
          p += static_cast<float>(cell % 4) * a + static_cast<float>(cell / 4 % 4) * b;
          if (cell < 16)
            add_quad(scene, "wall", white, p, a, b);
          else
            p[axis] += 3, add_quad(scene, "wall", white, p, b, a);
        }
    add_box(scene, "box", add_material(scene, "red", Rgb(0.6f, 0.1f, 0.1f)), Vec3(0.5f), Vec3(1.2f), false);
    return scene;
  }
  TracedScene traced() const { return {scene, world, tracer}; }
  void move(const Vec3& by) {
    for (Instance& instance : scene.instances)
      if (instance.name == "box") instance.transform[3] += glm::vec4(by, 0);
    world = make_world(scene);
    tracer = Tracer(scene, world);
  }
};

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}
bool same(const ClusterRows& a, const ClusterRows& b) {
  return same(a.basis.first, b.basis.first) && same(a.basis.indices, b.basis.indices) &&
         same(a.basis.codes, b.basis.codes) && same(a.basis.scales, b.basis.scales) &&
         same(a.basis.means, b.basis.means) && same(a.weights, b.weights) && same(a.scales, b.scales);
}

/// A lamp's indirect light on all receivers, through the operator.
std::vector<Rgb> answer(const Rooms& rooms, const Operator& op, const Vec3& lamp) {
  std::vector<Rgbx> light = slot_exitance(op, [&](std::size_t i) {
    const OperatorPoint& p = op.lit[i];
    const Vec3 at(p.position[0], p.position[1], p.position[2]), n = unpack_normal(p.geometric);
    const float distance = glm::distance(lamp, at);
    const Vec3 to = (lamp - at) / distance;
    const float cosine = glm::dot(n, to);
    if (cosine <= 0 || rooms.tracer.occluded({offset_origin(at, n, n), to, distance})) return Rgb();
    return Rgb(cosine / (distance * distance));
  });
  std::vector<Rgb> placed(static_cast<std::size_t>(op.width)), rows = indirect_light(op, light);
  for (std::size_t i = 0; i < rows.size(); ++i) placed[op.places[i]] = rows[i];
  return placed;
}

constexpr Vec3 kLamp(1.5f, 2.6f, 0.4f);

double mean(const std::vector<Rgb>& light) {
  double sum = 0;
  for (const Rgb& e : light) sum += static_cast<double>(e.g);
  return sum / static_cast<double>(light.size());
}
/// Share of the mean.
double rmse(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    squares += static_cast<double>(a[i].g - b[i].g) * static_cast<double>(a[i].g - b[i].g);
  return std::sqrt(squares / static_cast<double>(a.size())) / mean(b);
}

TEST(OperatorParts, WhatSawTheBoxIsMadeAgain) {
  Rooms one, other;
  OperatorParts some(one.traced(), vertex_receivers(one.traced()), quick(), "", {});
  OperatorParts every(other.traced(), vertex_receivers(other.traced()), quick(), "", {});
  EXPECT_TRUE(same(some.make({}).gather, every.make({}).gather));
  Operator now;
  for (const Vec3 by : {Vec3(1.1f, 0, 0), Vec3(0, 0.6f, 0.9f)}) {
    one.move(by), other.move(by);
    FollowReport report, whole;
    now = some.follow({}, &report);
    const Operator all = every.follow({}, &whole, true);
    EXPECT_TRUE(same(now.gather, all.gather));
    EXPECT_TRUE(same(now.first, all.first));
    EXPECT_TRUE(same(now.bounce, all.bounce));
    EXPECT_TRUE(same(now.albedo, all.albedo));
    for (std::size_t i = 0; i < now.lit.size(); ++i) ASSERT_EQ(now.lit[i].position, all.lit[i].position);
    // The second room saw nothing.
    EXPECT_EQ(whole.slots, 1024u);
    EXPECT_EQ(whole.receivers, now.gather.rows);
    EXPECT_LT(report.slots, 700u);
    EXPECT_LT(report.receivers, 3 * now.gather.rows / 4);
    EXPECT_LT(report.clusters, whole.clusters);
  }
  // And is it right? As far from an operator that is made there as two of those are from each other.
  TransferParams params = quick();
  const auto fresh = [&](uint32_t seed) {
    params.seed = seed;
    return answer(other, make_operator(other.traced(), vertex_receivers(other.traced()), params, ""), kLamp);
  };
  const std::vector<Rgb> is = answer(one, now, kLamp), right = fresh(1), also_right = fresh(2);
  EXPECT_LT(rmse(is, right), 1.3 * rmse(also_right, right)) << rmse(also_right, right);
  EXPECT_NEAR(mean(is) / mean(right), 1, 0.04) << mean(also_right) / mean(right);
}

TEST(OperatorParts, NothingMoved) {
  Rooms rooms;
  OperatorParts parts(rooms.traced(), vertex_receivers(rooms.traced()), quick(), "", {});
  const Operator before = parts.make({});
  FollowReport report;
  EXPECT_TRUE(same(parts.follow({}, &report).gather, before.gather));
  EXPECT_EQ(report.clusters, 0u);
}

TEST(OperatorParts, OnlyWhereItWasAskedFor) {
  Rooms rooms;
  TransferParams params = quick();
  params.movable = false;
  OperatorParts parts(rooms.traced(), vertex_receivers(rooms.traced()), params, "", {});
  parts.make({});
  EXPECT_THROW(parts.follow({}), UsageError);
}

}  // namespace
}  // namespace sconce
