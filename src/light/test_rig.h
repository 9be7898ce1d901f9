// SPDX-License-Identifier: Apache-2.0
// For tests only: the lamps of a scene whose groups follow by themselves.
#pragma once

#include "light/lamp.h"
#include "scene/groups.h"

namespace sconce {

inline constexpr double kPiD = 3.14159265358979323846;

struct LampRig {
  Scene scene;
  World world;
  Lamps lamps;

  explicit LampRig(Scene s)
      : scene((assign_groups(s, Grouping::automatic), std::move(s))),
        world(make_world(scene)),
        lamps(scene, world) {}
};

}  // namespace sconce
