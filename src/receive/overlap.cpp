// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "receive/parameterize.h"

namespace sconce {

namespace {

/// Which side of a->b the point lies on. Evaluated in one direction for both users of an edge, so that they
/// always disagree and a sample on a common edge belongs to exactly one of them.
bool left_of(Vec2 a, Vec2 b, Vec2 p) {
  const bool swap = b.x < a.x || (b.x == a.x && b.y < a.y);
  if (swap) std::swap(a, b);
  const double e = (static_cast<double>(b.x) - a.x) * (static_cast<double>(p.y) - a.y) -
                   (static_cast<double>(b.y) - a.y) * (static_cast<double>(p.x) - a.x);
  return swap ? !(e > 0) : e > 0;
}

}  // namespace

bool overlaps_itself(std::span<const std::array<Vec2, 3>> triangles) {
  if (triangles.size() < 2) return false;
  Vec2 lo(1e30f), hi(-1e30f);
  for (const auto& t : triangles)
    for (const Vec2& p : t) lo = glm::min(lo, p), hi = glm::max(hi, p);
  const Vec2 size = hi - lo;
  if (!(size.x > 0) || !(size.y > 0)) return false;
  const double samples = std::clamp(32.0 * static_cast<double>(triangles.size()), 1024.0, 1048576.0);
  const double step = std::sqrt(static_cast<double>(size.x) * static_cast<double>(size.y) / samples);
  const int width = std::clamp(static_cast<int>(std::ceil(static_cast<double>(size.x) / step)), 1, 8192);
  const int height = std::clamp(static_cast<int>(std::ceil(static_cast<double>(size.y) / step)), 1, 8192);
  const Vec2 scale(static_cast<float>(width) / size.x, static_cast<float>(height) / size.y);

  std::vector<uint8_t> count(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  std::size_t covered = 0, twice = 0;
  for (auto t : triangles) {
    if (signed_area(t) < 0) std::swap(t[1], t[2]);
    for (Vec2& p : t) p = (p - lo) * scale;
    const Vec2 from = glm::min(t[0], glm::min(t[1], t[2])), to = glm::max(t[0], glm::max(t[1], t[2]));
    const int x0 = std::max(0, static_cast<int>(std::floor(from.x - 0.5f)));
    const int x1 = std::min(width - 1, static_cast<int>(std::ceil(to.x)));
    const int y0 = std::max(0, static_cast<int>(std::floor(from.y - 0.5f)));
    const int y1 = std::min(height - 1, static_cast<int>(std::ceil(to.y)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        if (!left_of(t[0], t[1], p) || !left_of(t[1], t[2], p) || !left_of(t[2], t[0], p)) continue;
        uint8_t& c = count[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)];
        if (c == 0) ++covered;
        if (c == 1) ++twice;
        c = static_cast<uint8_t>(std::min(c + 1, 2));
      }
    }
  }
  return twice > 2 + covered / 500;
}

}  // namespace sconce
