// SPDX-License-Identifier: Apache-2.0
#include "import/triangulate.h"

#include <gtest/gtest.h>

namespace sconce {
namespace {

using Corners = std::vector<Vec3>;

/// Sum of the areas, and of them seen along the polygon's normal: alike where nothing lies outside it.
struct Areas {
  float sum = 0;
  Vec3 vector{0};
};

Areas areas(const Corners& corners) {
  Areas out;
  for (const auto& [a, b, c] : triangulate(corners)) {
    const Vec3 half = 0.5f * glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
    out.sum += glm::length(half), out.vector += half;
  }
  return out;
}

TEST(Triangulate, ConcaveOnesStayWithin) {
  const Corners l = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Corners comb = {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0},
                        {3, 1, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {0, 1, 0}};
  const Corners arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};  // from its first corner it is crossed
  const std::pair<Corners, float> cases[] = {{l, 3}, {comb, 9}, {arrow, 1}};
  for (const auto& [corners, area] : cases)
    for (const int axis : {0, 1, 2})
      for (std::size_t first = 0; first < corners.size(); ++first) {
        Corners turned;
        for (std::size_t i = 0; i < corners.size(); ++i) {
          const Vec3& p = corners[(first + i) % corners.size()];
          turned.push_back(Vec3(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) + Vec3(100));
        }
        EXPECT_EQ(triangulate(turned).size(), corners.size() - 2);
        EXPECT_NEAR(areas(turned).sum, area, 1e-4) << axis << " " << first;
        EXPECT_NEAR(glm::length(areas(turned).vector), area, 1e-4) << axis << " " << first;
        EXPECT_GT(areas(turned).vector[(5 - axis) % 3], 0) << "wound as it was";
      }
}

TEST(Triangulate, ConvexOnesAreFansAndCrossedOnesEnd) {
  const Corners square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(square), (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(triangulate(std::span(square).first(2)).empty());
  const Corners crossed = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(crossed).size(), 2u);
  EXPECT_EQ(triangulate(Corners(9, Vec3(1))).size(), 7u);
  EXPECT_EQ(triangulate(Corners(9, Vec3(NAN))).size(), 7u);
}

}  // namespace
}  // namespace sconce
