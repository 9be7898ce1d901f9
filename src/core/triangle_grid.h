// SPDX-License-Identifier: Apache-2.0
// A triangle cut into n x n congruent ones, numbered row by row: row y holds 2 (n - 1 - y) + 1 of them.
#pragma once

#include <array>
#include <cstdint>

#include "core/vec.h"

namespace sconce {

/// Index of the part that holds barycentric coordinates b (weights of vertices 1 and 2).
/// @param local  set to the barycentric coordinates on that part
inline uint32_t grid_part(Vec2 b, int n, Vec2& local) {
  local = b;
  if (n == 1) return 0;
  const float fx = b.x * static_cast<float>(n), fy = b.y * static_cast<float>(n);
  const int y = std::clamp(static_cast<int>(fy), 0, n - 1);
  const int x = std::clamp(static_cast<int>(fx), 0, n - 1 - y);
  const bool upper = x + y < n - 1 && (fx - static_cast<float>(x)) + (fy - static_cast<float>(y)) > 1;
  local = Vec2(fx, fy) - Vec2(static_cast<float>(x), static_cast<float>(y));
  if (upper) local = Vec2(1) - local;
  return static_cast<uint32_t>(y * (2 * n - y) + 2 * x + (upper ? 1 : 0));
}

inline uint32_t grid_part(Vec2 b, int n) {
  Vec2 local;
  return grid_part(b, n, local);
}

/// Barycentric corners of a part, wound as the triangle.
inline std::array<Vec2, 3> grid_corners(uint32_t part, int n) {
  // Row y begins at n2 - (n - y)2.
  const double left = static_cast<double>(n) * n - part;
  const int y = n - static_cast<int>(std::ceil(std::sqrt(left)));
  const int rest = static_cast<int>(part) - y * (2 * n - y);
  const float step = 1.0f / static_cast<float>(n);
  const Vec2 b(static_cast<float>(rest / 2) * step, static_cast<float>(y) * step);
  const Vec2 right = b + Vec2(step, 0), above = b + Vec2(0, step);
  if (rest % 2 == 0) return {b, right, above};
  return {b + Vec2(step, step), above, right};
}

}  // namespace sconce
