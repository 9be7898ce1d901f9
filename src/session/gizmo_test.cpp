// SPDX-License-Identifier: Apache-2.0
#include "session/gizmo.h"

#include <gtest/gtest.h>

namespace sconce {
namespace {

/// From above and aside, so that no axis is seen from its end.
Lens lens() {
  Camera camera = look_at(Vec3(2, 3, 4), Vec3(0));
  return Lens(camera, {.width = 640, .height = 480});
}

TEST(Gizmo, ArrowsAreFoundWhereTheyAreDrawn) {
  const Lens from = lens();
  const Gizmo gizmo = Gizmo::of(from, Vec3(0.1f, 0.2f, -0.1f), 80);
  for (const Grip grip : kGrips) {
    const auto tip = project(from, gizmo.tip(grip));
    ASSERT_TRUE(tip);
    EXPECT_EQ(gizmo.at(from, *tip, 8), grip);
  }
  EXPECT_EQ(gizmo.at(from, Vec2(5, 5), 8), Grip::none);
  EXPECT_FALSE(project(from, Vec3(4, 6, 8))) << "behind the eye";
  // An arrow across the view is as long as it was asked to be.
  const Lens front(look_at(Vec3(0, 0, 5), Vec3(0)), {.width = 640, .height = 480});
  const Gizmo facing = Gizmo::of(front, Vec3(0), 80);
  EXPECT_NEAR(glm::distance(*project(front, facing.tip(Grip::x)), Vec2(320, 240)), 80, 0.01);
}

// What is dragged stays under the pointer: from the picture of one place to that of another, the centre goes
// from there to there.
TEST(Gizmo, ADragGoesWhereThePointerGoes) {
  const Lens from = lens();
  const Vec3 center(0.1f, 0.2f, -0.1f);
  const std::pair<Grip, Vec3> ways[] = {{Grip::x, Vec3(0.7f, 0, 0)},
                                        {Grip::y, Vec3(0, -0.5f, 0)},
                                        {Grip::z, Vec3(0, 0, 0.4f)},
                                        {Grip::floor, Vec3(-0.3f, 0, 0.6f)}};
  for (const auto& [grip, way] : ways) {
    const Vec2 a = *project(from, center), b = *project(from, center + way);
    EXPECT_LT(glm::distance(dragged(grip, center, from, a, b), center + way), 1e-4f) << int(grip);
  }
  // Over the horizon, and along an arrow.
  const Lens level(look_at(Vec3(0, 1, 5), Vec3(0, 1, 0)), {.width = 640, .height = 480});
  EXPECT_EQ(dragged(Grip::floor, Vec3(0), level, Vec2(320, 400), Vec2(320, 100)), Vec3(0));
  EXPECT_EQ(dragged(Grip::z, Vec3(0, 1, 0), level, Vec2(320, 240), Vec2(321, 240)), Vec3(0, 1, 0));
}

}  // namespace
}  // namespace sconce
