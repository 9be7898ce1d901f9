// SPDX-License-Identifier: Apache-2.0
#include "session/turntable.h"

#include <cmath>

namespace sconce {

Camera turned(const Camera& camera, const Vec3& through, int step, int steps) {
  if (step % steps == 0) return camera;
  const double angle = 2 * double{kPi} * step / steps;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  const auto turn = [&](const Vec3& v) { return Vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  Camera out = camera;
  for (int i = 0; i < 3; ++i) out.frame[i] = glm::vec4(turn(Vec3(camera.frame[i])), 0);
  out.frame[3] = glm::vec4(through + turn(Vec3(camera.frame[3]) - through), 1);
  return out;
}

Vec3 turntable_axis(const View& view, const Camera& camera) {
  constexpr int kParts = 64;  // of the circle that is tried
  const Vec3 middle = view.world().bounds.center();
  for (int i = 0; i < kParts; ++i) {
    const Vec3 from(turned(camera, middle, i, kParts).frame[3]),
        way = Vec3(turned(camera, middle, i + 1, kParts).frame[3]) - from;
    const float length = glm::length(way);
    if (length > 0 && view.tracer().occluded({from, way / length, length})) return Vec3(camera.frame[3]);
  }
  return middle;
}

}  // namespace sconce
