// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "receive/density.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

TEST(Importance, CodesAreCloseAndNeverNothing) {
  for (const double value : {0.01, 0.3, 1.0, 7.0, 16.0})
    EXPECT_NEAR(std::log2(static_cast<double>(importance_of(importance_code(value))) / value), 0, 1 / 32.0);
  EXPECT_EQ(importance_of(importance_code(1000)), kMostImportance);
  EXPECT_GT(importance_of(importance_code(0)), 0);
  EXPECT_LT(importance_of(importance_code(0)), 1e-3f);
}

// Large triangles are taken at their word, small ones at that of all.
TEST(Importance, FewVisitsSayLittle) {
  MeshGraph graph;
  graph.areas = {1000, 1000, 1, 1};
  Visibility seen;
  seen.reference = 1;
  seen.first = {0, 1, 1, 1, 1, 2, 2, 2, 2};
  seen.visits = {{0, 2000, 0}, {4, 3, 0}};
  const std::vector<double> found = importances(seen, graph, {0, 1, 2, 3}, false);
  const double mean = 2003 / 2002.0;
  EXPECT_NEAR(found[0], 2, 0.01);
  EXPECT_NEAR(found[1], 0, 0.01);
  EXPECT_NEAR(found[2], mean, 0.25);
  EXPECT_NEAR(found[3], mean, 0.25);
  EXPECT_GT(found[2], found[3]);
  EXPECT_EQ(importances(seen, graph, {0, 1, 2, 3}, true), std::vector<double>(4, 0.0)) << "no back was met";
}

// A camera close to one wall of a dark room: what it looks at counts, what lies below the floor does not.
TEST(Importance, TexelsCountAsTheyAreLookedAt) {
  TestScene s;
  const Id<Material> wall = add_material(s.scene, "wall", Rgb(0.5f));
  add_box(s.scene, "room", wall, Vec3(0), Vec3(8, 3, 8), true);
  add_quad(s.scene, "cellar", wall, Vec3(0, -3, 8), Vec3(8, 0, 0), Vec3(0, 0, -8));
  s.look(Vec3(4, 1.5f, 2), Vec3(4, 1.5f, 0), 1);
  s.finish();
  s.unwrap(10);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  float ahead = 0, behind = 0, cellar = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const uint32_t triangle = receivers.triangle(i);
    const float importance = receivers.importance(i);
    const Vec3 middle = s.world.position(triangle, Vec2(1.0f / 3));
    if (middle.y < -1)
      cellar = std::max(cellar, importance);
    else if (middle.z < 0.01f)
      ahead = std::max(ahead, importance);
    else if (middle.z > 7.99f)
      behind = std::max(behind, importance);
  }
  EXPECT_GT(ahead, 4 * behind);
  EXPECT_GT(behind, 10 * cellar);
  EXPECT_GT(cellar, 0);
}

}  // namespace
}  // namespace sconce
