// SPDX-License-Identifier: Apache-2.0
// Small vectors. A colour is not a position: colours are Rgb (core/rgb.h).
#pragma once

#include <algorithm>
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
  const float half = 0.5f * std::min(u.x, u.y);
  return {u.x - half, u.y - half};
}

/// Uniform direction, density 1/(4 pi).
inline Vec3 square_to_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Cosine-distributed direction about +z, density cos/pi, by Shirley & Chiu's concentric map: strata stay
/// compact. Which wedge a point falls into is a coin toss, so this takes no branch on it.
inline Vec3 square_to_cosine(Vec2 u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  const float wide = std::abs(a) > std::abs(b) ? 1.0f : 0.0f, tall = 1 - wide;
  const float r = wide * a + tall * b;
  if (r == 0) return {0, 0, 1};
  // Sine and cosine of at most pi/4 by their Taylor series: errors below 1e-7, and no call.
  const float phi = kPi / 4 * (wide * b + tall * a) / r, q = phi * phi;
  const float sine = phi * (1 - q * (1.0f / 6 - q * (1.0f / 120 - q * (1.0f / 5040 - q * (1.0f / 362880)))));
  const float cosine = 1 - q * (0.5f - q * (1.0f / 24 - q * (1.0f / 720 - q * (1.0f / 40320))));
  const float x = r * (wide * cosine + tall * sine), y = r * (wide * sine + tall * cosine);
  return {x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
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
