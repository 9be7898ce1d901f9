// SPDX-License-Identifier: Apache-2.0
// Handles that a lamp is dragged by, and what a drag of one means. Values in, values out.
#pragma once

#include <array>

#include "scene/lens.h"

namespace sconce {

/// In pixels from the top left; none for what is behind the eye.
std::optional<Vec2> project(const Lens& lens, const Vec3& point);

/// An arrow along each axis, and a square in the horizontal plane.
enum class Grip : uint8_t { none, x, y, z, floor };
inline constexpr std::array kGrips{Grip::floor, Grip::x, Grip::y, Grip::z};

struct Gizmo {
  Vec3 center{0};
  float length = 1;  ///< of an arrow, m

  /// With arrows of so many pixels, seen from the front. @pre the centre is in front of the eye
  static Gizmo of(const Lens& lens, const Vec3& center, float pixels);
  /// The end of an arrow, or the middle of the square.
  Vec3 tip(Grip grip) const;
  std::array<Vec3, 4> square() const;
  /// What is under a pixel, no further away than `near` pixels.
  Grip at(const Lens& lens, Vec2 pixel, float near) const;
};

/// Where the centre goes when what was at one pixel is dragged to another: along the axis, or in the plane
/// through the centre. It stays where the view tells nothing (along an arrow, over the horizon).
Vec3 dragged(Grip grip, const Vec3& center, const Lens& lens, Vec2 from, Vec2 to);

}  // namespace sconce
