// SPDX-License-Identifier: Apache-2.0
// Which texels a triangle covers, however little.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.h"

namespace sconce {

/// Overlaps thinner than this many texels are rounding, not coverage.
inline constexpr float kTouch = 1e-3f;

/// Calls f(x, y) for every texel [x, x+1) x [y, y+1) of a page that the triangle (texel coordinates, either
/// winding) covers any part of, row by row; at least one, also for a triangle without area.
template <class F>
void cover_texels(const std::array<Vec2, 3>& t, int width, int height, F&& f, float touch = kTouch) {
  const Vec2 lo = glm::min(t[0], glm::min(t[1], t[2])), hi = glm::max(t[0], glm::max(t[1], t[2]));
  const auto clamp_to = [](float v, int size) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, size - 1);
  };
  const int x0 = clamp_to(lo.x + touch, width), x1 = std::max(x0, clamp_to(hi.x - touch, width));
  const int y0 = clamp_to(lo.y + touch, height), y1 = std::max(y0, clamp_to(hi.y - touch, height));
  if (x0 == x1 || y0 == y1) {
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) f(x, y);
    return;
  }
  // Separating axes: the box's two are in the bounds above, the triangle's three edge normals remain.
  std::array<Vec2, 3> normal;
  std::array<float, 3> limit;
  const Vec2 e1 = t[1] - t[0], e2 = t[2] - t[0];
  const float winding = e1.x * e2.y - e1.y * e2.x < 0 ? -1.0f : 1.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 edge = t[(k + 1) % 3] - t[k];
    const float length = glm::length(edge);
    normal[k] = length > 0 ? winding * Vec2(-edge.y, edge.x) / length : Vec2(0);  // inwards
    // The box's corner farthest inside must lie inside by more than rounding.
    const Vec2 reach(normal[k].x > 0 ? 1.0f : 0.0f, normal[k].y > 0 ? 1.0f : 0.0f);
    limit[k] = glm::dot(normal[k], t[k] - reach) + (length > 0 ? touch : -1.0f);
  }
  bool any = false;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 p(static_cast<float>(x), static_cast<float>(y));
      if (glm::dot(normal[0], p) < limit[0] || glm::dot(normal[1], p) < limit[1] ||
          glm::dot(normal[2], p) < limit[2])
        continue;
      any = true;
      f(x, y);
    }
  }
  if (!any) {
    const Vec2 c = (t[0] + t[1] + t[2]) / 3.0f;
    f(clamp_to(c.x, width), clamp_to(c.y, height));
  }
}

}  // namespace sconce
