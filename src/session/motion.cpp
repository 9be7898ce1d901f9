// SPDX-License-Identifier: Apache-2.0
#include "session/motion.h"

#include <algorithm>
#include <cmath>

#include "scene/lens.h"

namespace sconce {

namespace {

constexpr float kSteepest = 1.55f;  // radians; straight up has no right side

Vec3 axis(const Camera& camera, int i) {
  return normalize_or(Vec3(camera.frame[i]), Vec3(0));
}
Vec3 eye(const Camera& camera) {
  return Vec3(camera.frame[3]);
}

/// A direction as yaw and pitch, turned, and back.
Vec3 turned(const Vec3& direction, Vec2 turn) {
  const float yaw = std::atan2(direction.x, -direction.z) + turn.x;
  const float pitch =
      std::clamp(std::asin(std::clamp(direction.y, -1.0f, 1.0f)) + turn.y, -kSteepest, kSteepest);
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

Camera placed(const Camera& like, const Vec3& at, const Vec3& ahead) {
  Camera camera = look_at(at, at + ahead);
  camera.name = like.name, camera.yfov = like.yfov, camera.aspect = like.aspect;
  return camera;
}

}  // namespace

Camera orbit(const Camera& camera, const Vec3& center, Vec2 turn) {
  const Vec3 to = center - eye(camera), ahead = -axis(camera, 2);
  const float distance = glm::length(to);
  if (!(distance > 0)) return look_around(camera, turn);
  // The centre may lie beside the picture's middle; it stays where it is.
  const Vec3 seen = to / distance, moved = turned(seen, turn);
  const Vec2 offset(std::atan2(ahead.x, -ahead.z) - std::atan2(seen.x, -seen.z),
                    std::asin(std::clamp(ahead.y, -1.0f, 1.0f)) - std::asin(std::clamp(seen.y, -1.0f, 1.0f)));
  return placed(camera, center - distance * moved, turned(moved, offset));
}

Camera look_around(const Camera& camera, Vec2 turn) {
  return placed(camera, eye(camera), turned(-axis(camera, 2), turn));
}

Camera fly(const Camera& camera, const Vec3& step) {
  Camera moved = camera;
  moved.frame[3] += glm::vec4(step.x * axis(camera, 0) + Vec3(0, step.y, 0) - step.z * axis(camera, 2), 0);
  return moved;
}

Camera pan(const Camera& camera, Vec2 step) {
  Camera moved = camera;
  moved.frame[3] += glm::vec4(step.x * axis(camera, 0) + step.y * axis(camera, 1), 0);
  return moved;
}

Camera approach(const Camera& camera, const Vec3& center, float share) {
  constexpr float kNearest = 0.05f;  // metres
  Camera moved = camera;
  const Vec3 to = center - eye(camera);
  const float distance = glm::length(to);
  const float left = std::max(distance * (1 - share), std::min(distance, kNearest));
  if (distance > 0) moved.frame[3] = glm::vec4(center - left / distance * to, 1);
  return moved;
}

Camera frame_all(const Camera& camera, const Bounds& bounds) {
  const float radius = 0.5f * bounds.diagonal(), half = 0.5f * std::min(camera.yfov, 1.0f);
  const Vec3 ahead = normalize_or(-axis(camera, 2), Vec3(0, 0, -1));
  return placed(camera, bounds.center() - radius / std::sin(half) * ahead, ahead);
}

}  // namespace sconce
