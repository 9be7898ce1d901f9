// SPDX-License-Identifier: Apache-2.0
#include "gather/cells.h"

#include "core/triangle_grid.h"

namespace sconce {

namespace {

constexpr int kMostCuts = 1024;

}  // namespace

std::vector<double> side_areas(const Scene& scene, const World& world) {
  std::vector<double> areas(2 * world.size(), 0.0);
  for (uint32_t t = 0; t < world.size(); ++t) {
    areas[side_index(t, false)] = static_cast<double>(world.area(t));
    if (scene[world.materials[t]].double_sided) areas[side_index(t, true)] = areas[side_index(t, false)];
  }
  return areas;
}

SurfaceCells make_cells(const Scene& scene, const World& world, std::span<const double> mass,
                        std::size_t samples) {
  double total = 0;
  for (const double m : mass) total += m;
  SurfaceCells cells;
  cells.first.push_back(0);
  for (uint32_t t = 0; t < world.size(); ++t) {
    const bool both = scene[world.materials[t]].double_sided;
    const double densest = std::max(mass[side_index(t, false)], both ? mass[side_index(t, true)] : 0.0);
    const double expected = total > 0 ? static_cast<double>(samples) * densest / total : 0;
    int n = 1;
    if (expected > 0.25) {
      // Cells of 3/4 of the samples' spacing along the longest edge, so that slivers are cut too, but no more
      // than some 32 cells a sample.
      const auto& v = world.triangles[t].v;
      double longest = 0;
      for (std::size_t e = 0; e < 3; ++e)
        longest = std::max(longest, static_cast<double>(glm::distance(world.positions[v[e]],
                                                                      world.positions[v[(e + 1) % 3]])));
      const double spacing = std::sqrt(static_cast<double>(world.area(t)) / expected);
      const double wanted = std::min(longest / (0.75 * spacing), std::sqrt(32 * expected + 4));
      n = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, static_cast<double>(kMostCuts)));
    }
    cells.cut.push_back(static_cast<uint16_t>(n));
    const auto count = static_cast<uint32_t>(n * n);
    cells.first.push_back(cells.first.back() + count);
    cells.first.push_back(cells.first.back() + (both ? count : 0));
    for (const bool back : {false, true})
      if (!back || both) cells.sides.resize(cells.sides.size() + count, side_index(t, back));
  }
  return cells;
}

uint32_t SurfaceCells::at(uint32_t side, Vec2 barycentric) const {
  return first[side] + grid_part(barycentric, cut[side / 2]);
}

float SurfaceCells::area(const World& world, uint32_t cell) const {
  const uint32_t triangle = sides[cell] / 2;
  const float n = cut[triangle];
  return world.area(triangle) / (n * n);
}

std::array<Vec2, 3> SurfaceCells::corners(uint32_t cell) const {
  const uint32_t side = sides[cell];
  return grid_corners(cell - first[side], cut[side / 2]);
}

FootprintPiece SurfaceCells::piece(const World& world, uint32_t cell) const {
  const uint32_t side = sides[cell], triangle = side / 2;
  const float flip = (side & 1) != 0 ? -1.0f : 1.0f;
  const auto [a, b, c] = corners(cell);
  FootprintPiece piece;
  piece.p0 = world.position(triangle, a);
  piece.p1 = world.position(triangle, b);
  piece.p2 = world.position(triangle, c);
  piece.n0 = flip * world.normal(triangle, a);
  piece.n1 = flip * world.normal(triangle, b);
  piece.n2 = flip * world.normal(triangle, c);
  piece.geometric_normal = flip * world.face_normals[triangle];
  return piece;
}

SurfacePoint SurfaceCells::middle(const World& world, uint32_t cell) const {
  const uint32_t side = sides[cell], triangle = side / 2;
  const float flip = (side & 1) != 0 ? -1.0f : 1.0f;
  const auto [a, b, c] = corners(cell);
  const Vec2 m = (a + b + c) / 3.0f;
  return {world.position(triangle, m), flip * world.normal(triangle, m), flip * world.face_normals[triangle]};
}

}  // namespace sconce
