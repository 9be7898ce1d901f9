// SPDX-License-Identifier: Apache-2.0
// A camera that turns once around a scene.
#pragma once

#include "picture/render.h"

namespace sconce {

/// Turned around the vertical axis through a point, from above against the clock.
/// @param step  of `steps` equal ones to a whole turn; 0 = as it stands
Camera turned(const Camera& camera, const Vec3& through, int step, int steps);

/// What a camera turns around when nobody says: the middle of the scene; its own place where something stands
/// in the way of that circle, as walls do around a camera in a room.
Vec3 turntable_axis(const View& view, const Camera& camera);

}  // namespace sconce
