// SPDX-License-Identifier: Apache-2.0
#include "import/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sconce {

namespace {

constexpr std::size_t kMostForEars = 256;  // the search is cubic where there are none
using Corners = std::vector<uint32_t>;
using Point = glm::dvec2;

/// Seen along its area vector's longest axis (Newell), counter-clockwise.
std::vector<Point> flattened(std::span<const Vec3> corners) {
  glm::dvec3 area(0);
  const glm::dvec3 first(corners[0]);
  for (std::size_t i = 2; i < corners.size(); ++i)
    area += glm::cross(glm::dvec3(corners[i - 1]) - first, glm::dvec3(corners[i]) - first);
  const glm::dvec3 size = glm::abs(area);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Point> out;
  for (const Vec3& c : corners) out.push_back(area[axis] < 0 ? Point(c[v], c[u]) : Point(c[u], c[v]));
  return out;
}

/// Twice the area, positive to the left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_ear(const std::vector<Point>& p, const Corners& left, std::size_t i) {
  const std::size_t n = left.size();
  const Point &a = p[left[(i + n - 1) % n]], &b = p[left[i]], &c = p[left[(i + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  return std::none_of(left.begin(), left.end(), [&](uint32_t k) {  // seams of holes have corners twice
    return turn(a, b, p[k]) >= 0 && turn(b, c, p[k]) >= 0 && turn(c, a, p[k]) >= 0 && p[k] != a &&
           p[k] != b && p[k] != c;
  });
}

bool is_convex(const std::vector<Point>& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0) return false;
  return true;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners) {
  std::vector<std::array<uint32_t, 3>> out;
  if (corners.size() < 3) return out;
  Corners left(corners.size());
  std::iota(left.begin(), left.end(), 0u);
  if (left.size() > 3 && left.size() <= kMostForEars) {
    const std::vector<Point> points = flattened(corners);
    for (bool cut = !is_convex(points); cut && left.size() > 3;) {
      cut = false;
      for (std::size_t i = 0; i < left.size() && !cut; ++i) {
        if (!is_ear(points, left, i)) continue;
        const std::size_t n = left.size();
        out.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        cut = true;
      }
    }
  }
  for (std::size_t i = 2; i < left.size(); ++i) out.push_back({left[0], left[i - 1], left[i]});
  return out;
}

}  // namespace sconce
