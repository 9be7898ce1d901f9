// SPDX-License-Identifier: Apache-2.0
#include "gather/cells.h"

#include <numeric>

namespace sconce {

namespace {

constexpr int kMostCuts = 1024;

/// Cuts per edge for `pieces` pieces of this triangle: their spacing along the longest edge, so that slivers
/// are cut too, but no more than `most` pieces.
int cuts(const World& world, uint32_t triangle, double scale, double pieces, double most) {
  const auto& v = world.triangles[triangle].v;
  double longest = 0;
  for (std::size_t e = 0; e < 3; ++e)
    longest = std::max(longest, scale * static_cast<double>(glm::distance(world.positions[v[e]],
                                                                          world.positions[v[(e + 1) % 3]])));
  const double spacing = std::sqrt(scale * scale * static_cast<double>(world.area(triangle)) / pieces);
  return static_cast<int>(std::clamp(std::ceil(std::min(longest / spacing, std::sqrt(most))), 1.0,
                                     static_cast<double>(kMostCuts)));
}

template <class Cut>
SurfaceParts cut_sides(const Scene& scene, const World& world, Cut&& cut) {
  SurfaceParts parts;
  parts.first.push_back(0);
  for (uint32_t t = 0; t < world.size(); ++t) {
    const int n = cut(t);
    parts.cut.push_back(static_cast<uint16_t>(n));
    for (const bool back : {false, true}) {
      if (!back || scene[world.materials[t]].double_sided)
        parts.sides.resize(parts.sides.size() + static_cast<std::size_t>(n * n), side_index(t, back));
      parts.first.push_back(static_cast<uint32_t>(parts.sides.size()));
    }
  }
  return parts;
}

}  // namespace

SurfaceParts whole_sides(const Scene& scene, const World& world) {
  return cut_sides(scene, world, [](uint32_t) { return 1; });
}

SurfaceParts make_parts(const Scene& scene, const World& world, std::span<const double> mass,
                        std::size_t count) {
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  return cut_sides(scene, world, [&](uint32_t t) {
    const double densest = std::max(mass[side_index(t, false)], mass[side_index(t, true)]);
    const double pieces = total > 0 ? static_cast<double>(count) * densest / total : 0;
    return pieces > 1 ? cuts(world, t, 1, pieces, 4 * pieces) : 1;
  });
}

SurfaceCells make_cells(const World& world, SurfaceParts parts, std::span<const double> mass,
                        std::size_t samples) {
  // Cells of 3/4 of the samples' spacing, but no more than some 32 a sample.
  constexpr double kFiner = 16.0 / 9;
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  SurfaceCells cells;
  cells.first.push_back(0);
  for (uint32_t p = 0; p < parts.size(); ++p) {
    const uint32_t t = parts.sides[p] / 2;
    const double expected = total > 0 ? static_cast<double>(samples) * mass[p] / total : 0;
    const int n =
        expected > 0.25 ? cuts(world, t, 1.0 / parts.cut[t], kFiner * expected, 32 * expected + 4) : 1;
    cells.cut.push_back(static_cast<uint16_t>(n));
    cells.part_of.resize(cells.part_of.size() + static_cast<std::size_t>(n * n), p);
    cells.first.push_back(static_cast<uint32_t>(cells.part_of.size()));
  }
  cells.parts = std::move(parts);
  return cells;
}

float SurfaceCells::area(const World& world, uint32_t cell) const {
  const double n = cut[part_of[cell]];
  return static_cast<float>(parts.area(world, part_of[cell]) / (n * n));
}

std::array<Vec2, 3> SurfaceCells::corners(uint32_t cell) const {
  const uint32_t part = part_of[cell];
  const auto [a, b, c] = parts.corners(part);
  std::array<Vec2, 3> corners = grid_corners(cell - first[part], cut[part]);
  for (Vec2& corner : corners) corner = a + corner.x * (b - a) + corner.y * (c - a);
  return corners;
}

FootprintPiece SurfaceCells::piece(const World& world, uint32_t cell) const {
  const uint32_t triangle = side(cell) / 2;
  const float flip = (side(cell) & 1) != 0 ? -1.0f : 1.0f;
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
  const uint32_t triangle = side(cell) / 2;
  const float flip = (side(cell) & 1) != 0 ? -1.0f : 1.0f;
  const auto [a, b, c] = corners(cell);
  const Vec2 m = (a + b + c) / 3.0f;
  return {world.position(triangle, m), flip * world.normal(triangle, m), flip * world.face_normals[triangle]};
}

}  // namespace sconce
