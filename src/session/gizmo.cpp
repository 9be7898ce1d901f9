// SPDX-License-Identifier: Apache-2.0
#include "session/gizmo.h"

#include <algorithm>

namespace sconce {

namespace {

Vec3 axis_of(Grip grip) {
  return grip == Grip::x ? Vec3(1, 0, 0) : grip == Grip::y ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

/// How far along the axis through `center` a ray comes closest to it.
std::optional<float> along(const Vec3& center, const Vec3& axis, const Vec3& eye, const Vec3& direction) {
  const float cosine = glm::dot(axis, direction), across = 1 - cosine * cosine;
  if (across < 1e-3f) return std::nullopt;
  const Vec3 to = eye - center;
  return (glm::dot(axis, to) - cosine * glm::dot(direction, to)) / across;
}

/// Where a ray meets the horizontal plane through `center`.
std::optional<Vec3> on_floor(const Vec3& center, const Vec3& eye, const Vec3& direction) {
  if (std::abs(direction.y) < 1e-3f) return std::nullopt;
  const float distance = (center.y - eye.y) / direction.y;
  if (!(distance > 0)) return std::nullopt;
  return eye + distance * direction;
}

float distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 way = b - a;
  const float length2 = glm::dot(way, way);
  const float t = length2 > 0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0f, 1.0f) : 0;
  return glm::distance(p, a + t * way);
}

}  // namespace

std::optional<Vec2> project(const Lens& lens, const Vec3& point) {
  const Vec3 q = Mat3(glm::inverse(glm::dmat3(lens.plane()))) * (point - lens.eye());
  if (!(q.z > 1e-4f)) return std::nullopt;
  return Vec2(q) / q.z;
}

Gizmo Gizmo::of(const Lens& lens, const Vec3& center, float pixels) {
  const float depth = (Mat3(glm::inverse(glm::dmat3(lens.plane()))) * (center - lens.eye())).z;
  return {center, pixels * depth * glm::length(lens.plane()[0])};
}

Vec3 Gizmo::tip(Grip grip) const {
  if (grip != Grip::floor) return center + length * axis_of(grip);
  const std::array<Vec3, 4> corners = square();
  return 0.5f * (corners[0] + corners[2]);
}

std::array<Vec3, 4> Gizmo::square() const {
  const float near = 0.25f * length, far = 0.55f * length;
  const auto at = [&](float x, float z) { return center + Vec3(x, 0, z); };
  return {at(near, near), at(far, near), at(far, far), at(near, far)};
}

Grip Gizmo::at(const Lens& lens, Vec2 pixel, float near) const {
  const auto middle = project(lens, center);
  if (!middle) return Grip::none;
  if (const auto floor = project(lens, tip(Grip::floor)); floor && glm::distance(*floor, pixel) <= near)
    return Grip::floor;
  Grip best = Grip::none;
  float least = near;
  for (const Grip grip : {Grip::x, Grip::y, Grip::z}) {
    const auto end = project(lens, tip(grip));
    if (!end) continue;
    // Where arrows meet there is no telling which is meant.
    const float distance = distance_to_segment(pixel, *middle + 0.25f * (*end - *middle), *end);
    if (distance < least) least = distance, best = grip;
  }
  return best;
}

Vec3 dragged(Grip grip, const Vec3& center, const Lens& lens, Vec2 from, Vec2 to) {
  const Vec3 eye = lens.eye(), before = lens.direction(from), now = lens.direction(to);
  if (grip == Grip::none) return center;
  if (grip == Grip::floor) {
    const auto a = on_floor(center, eye, before), b = on_floor(center, eye, now);
    return a && b ? center + *b - *a : center;
  }
  const Vec3 axis = axis_of(grip);
  const auto a = along(center, axis, eye, before), b = along(center, axis, eye, now);
  return a && b ? center + (*b - *a) * axis : center;
}

}  // namespace sconce
