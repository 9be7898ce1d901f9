// SPDX-License-Identifier: Apache-2.0
// How a camera moves under mouse and keys. Values in, values out.
#pragma once

#include "scene/scene.h"

namespace sconce {

/// Turns around a point at rest; up stays up and the poles are not crossed. @param turn  radians: right, up
Camera orbit(const Camera& camera, const Vec3& center, Vec2 turn);
/// Turns the head.
Camera look_around(const Camera& camera, Vec2 turn);
/// @param step  metres: right, up in the world, ahead
Camera fly(const Camera& camera, const Vec3& step);
/// Moves in the picture plane. @param step  metres: right, up in the picture
Camera pan(const Camera& camera, Vec2 step);
/// Towards a point by a share of the distance; never through it.
Camera approach(const Camera& camera, const Vec3& center, float share);
/// All of the bounds in sight, from the side that it looks from.
Camera frame_all(const Camera& camera, const Bounds& bounds);

}  // namespace sconce
