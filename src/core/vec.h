// SPDX-License-Identifier: Apache-2.0
// Small vectors. A colour is not a position: colours are Rgb (core/rgb.h).
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace sconce {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;

/// Normalised v, or `fallback` where v has no usable length.
inline Vec3 normalize_or(const Vec3& v, const Vec3& fallback) {
  const float length = glm::length(v);
  return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
}

/// Low-distortion map of the unit square to barycentric weights of vertices 1 and 2 (Heitz 2019): uniform
/// stays uniform, and strata stay compact.
inline Vec2 square_to_triangle(Vec2 u) {
  if (u.y > u.x) return {0.5f * u.x, u.y - 0.5f * u.x};
  return {u.x - 0.5f * u.y, 0.5f * u.y};
}

/// Right-handed orthonormal frame whose third axis is n (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
struct Frame {
  Vec3 x, y, z;

  explicit Frame(const Vec3& n) : z(n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    x = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    y = Vec3(b, sign + n.y * n.y * a, -n.y);
  }
  Vec3 to_world(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

struct Bounds {
  Vec3 lo{1e30f}, hi{-1e30f};

  void add(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  bool empty() const { return lo.x > hi.x; }
  Vec3 center() const { return 0.5f * (lo + hi); }
  float diagonal() const { return empty() ? 0.0f : glm::length(hi - lo); }
};

}  // namespace sconce
