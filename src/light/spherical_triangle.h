// SPDX-License-Identifier: Apache-2.0
// A triangle as a point sees it: its solid angle, and directions uniform in it (Arvo, "Stratified Sampling of
// Spherical Triangles", SIGGRAPH 1995).
#pragma once

#include <cmath>

#include "core/vec.h"

namespace sconce {

/// By unit vectors to the corners.
class SphericalTriangle {
 public:
  SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
      : a_(glm::normalize(a)), b_(glm::normalize(b)), c_(glm::normalize(c)) {}

  /// sr, by Van Oosterom and Strackee (1983), which is stable for thin triangles.
  float solid_angle() const {
    const float volume = std::abs(glm::dot(a_, glm::cross(b_, c_)));
    return 2 * std::atan2(volume, 1 + glm::dot(a_, b_) + glm::dot(b_, c_) + glm::dot(c_, a_));
  }

  /// A direction, uniform for u in [0,1)^2; unit.
  Vec3 sample(Vec2 u) const {
    const Vec3 ab = glm::cross(a_, b_), ac = glm::cross(a_, c_);
    const float inverse = 1 / std::sqrt(std::max(1e-30f, glm::dot(ab, ab) * glm::dot(ac, ac)));
    const float cos_alpha = std::clamp(glm::dot(ab, ac) * inverse, -1.0f, 1.0f);
    const float sin_alpha = std::sqrt(std::max(0.0f, 1 - cos_alpha * cos_alpha));
    // The part of the triangle between a b and a new corner on a c has the share u.x of the area.
    const float area = u.x * solid_angle();
    const float sin_area = std::sin(area), cos_area = std::cos(area);
    const float s = sin_area * cos_alpha - cos_area * sin_alpha;  // sin and cos of area - alpha
    const float t = cos_area * cos_alpha + sin_area * sin_alpha;
    const float p = t - cos_alpha, q = s + sin_alpha * glm::dot(a_, b_);
    const float below = (q * s + p * t) * sin_alpha;
    const float cos_side =
        std::abs(below) > 1e-12f ? std::clamp(((q * t - p * s) * cos_alpha - q) / below, -1.0f, 1.0f) : 1.0f;
    const Vec3 corner = cos_side * a_ + sine(cos_side) * across(c_, a_);
    const float z = 1 - u.y * (1 - std::clamp(glm::dot(corner, b_), -1.0f, 1.0f));
    return z * b_ + sine(z) * across(corner, b_);
  }

 private:
  static float sine(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }
  /// Unit, the part of v at right angles to `axis`; nothing where there is none.
  static Vec3 across(const Vec3& v, const Vec3& axis) {
    const Vec3 d = v - glm::dot(v, axis) * axis;
    const float l2 = glm::dot(d, d);
    return l2 > 1e-20f ? d / std::sqrt(l2) : Vec3(0);
  }

  Vec3 a_, b_, c_;
};

}  // namespace sconce
