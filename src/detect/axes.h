// SPDX-License-Identifier: Apache-2.0
// The six directions that detection sends light from: each face has the one that it looks along most.
#pragma once

#include "scene/world.h"

namespace sconce {

inline constexpr std::size_t kAxes = 6;

/// 2 x coordinate, + 1 where negative.
inline std::size_t facing_axis(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::size_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

inline Vec3 axis_direction(std::size_t axis) {
  Vec3 d(0);
  d[static_cast<int>(axis / 2)] = axis % 2 == 0 ? 1.0f : -1.0f;
  return d;
}

/// A place from which all of the world is seen along about the same direction.
inline Vec3 far_eye(const World& world, const Vec3& direction) {
  return world.bounds.center() + 10 * world.bounds.diagonal() * direction;
}

}  // namespace sconce
