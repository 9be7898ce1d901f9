// SPDX-License-Identifier: Apache-2.0
#include "session/turntable.h"

#include <gtest/gtest.h>

#include "core/test_folder.h"
#include "package/test_package.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TEST(Turntable, QuartersOfATurn) {
  const Camera camera = look_at(Vec3(1, 2, 5), Vec3(1, 0, 1));
  const Vec3 through(1, 0, 1);
  EXPECT_EQ(turned(camera, through, 0, 4).frame, camera.frame);
  EXPECT_EQ(turned(camera, through, 4, 4).frame, camera.frame);
  const Vec3 places[] = {{1, 2, 5}, {5, 2, 1}, {1, 2, -3}, {-3, 2, 1}};
  for (int i = 0; i < 4; ++i) {
    const Camera there = turned(camera, through, i, 4);
    EXPECT_LT(glm::distance(Vec3(there.frame[3]), places[i]), 1e-5f) << i;
    const Camera expected = look_at(places[i], through);  // still at the middle, upright
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(glm::length(there.frame[axis] - expected.frame[axis]), 1e-5f) << i << axis;
  }
}

// A circle of 2 m is free around a wall that is 2 m wide; one of 0.5 m would go through it.
TEST(Turntable, WallsAreNotCrossed) {
  TemporaryFolder folder;
  write_package(folder / "x.sconce", test_package(1, 1, 8, 8));
  const Package package = Package::open(folder / "x.sconce");
  const View view(package);
  const auto axis = [&](const Vec3& eye) { return turntable_axis(view, look_at(eye, Vec3(0, 0.2f, 0))); };
  EXPECT_EQ(axis(Vec3(0, 0, 2)), Vec3(0));
  EXPECT_EQ(axis(Vec3(0, 0, 0.5f)), Vec3(0, 0, 0.5f));
}

}  // namespace
}  // namespace sconce
