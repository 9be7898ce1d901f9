// SPDX-License-Identifier: Apache-2.0
// The reflecting surface cut into small cells: what a ray's hit falls into without any search. Two grids, one
// in the other: sides of triangles are cut into parts, so that large triangles can be fine in places only,
// and parts into cells.
#pragma once

#include <span>
#include <vector>

#include "core/receiver.h"
#include "core/triangle_grid.h"
#include "scene/world.h"
#include "trace/tracer.h"

namespace sconce {

/// A side of a triangle: 2 x triangle, + 1 for its back.
constexpr uint32_t side_index(uint32_t triangle, bool back) {
  return 2 * triangle + (back ? 1 : 0);
}

/// Equal parts of all sides that reflect: fronts, and backs of double-sided materials.
struct SurfaceParts {
  std::vector<uint32_t> first;  ///< per side and one more
  std::vector<uint16_t> cut;    ///< per triangle: each side has cut x cut parts
  std::vector<uint32_t> sides;  ///< per part

  std::size_t size() const { return sides.size(); }
  bool reflects(uint32_t side) const { return first[side] != first[side + 1]; }
  /// Part of a point; only for sides that have parts.
  uint32_t at(uint32_t side, Vec2 barycentric, Vec2& local) const {
    return first[side] + grid_part(barycentric, cut[side / 2], local);
  }
  /// Barycentric coordinates of a part's corners on its triangle.
  std::array<Vec2, 3> corners(uint32_t part) const {
    return grid_corners(part - first[sides[part]], cut[sides[part] / 2]);
  }
  /// m2
  double area(const World& world, uint32_t part) const {
    const double n = cut[sides[part] / 2];
    return static_cast<double>(world.area(sides[part] / 2)) / (n * n);
  }
};

/// Equal cells of each part.
struct SurfaceCells {
  SurfaceParts parts;
  std::vector<uint32_t> first;    ///< per part and one more
  std::vector<uint16_t> cut;      ///< per part
  std::vector<uint32_t> part_of;  ///< per cell: its part

  std::size_t size() const { return part_of.size(); }
  bool reflects(uint32_t side) const { return parts.reflects(side); }
  /// Cell of a point; only for sides that have cells.
  uint32_t at(uint32_t side, Vec2 barycentric) const {
    Vec2 local;
    const uint32_t part = parts.at(side, barycentric, local);
    return first[part] + grid_part(local, cut[part]);
  }
  uint32_t side(uint32_t cell) const { return parts.sides[part_of[cell]]; }
  /// m2
  float area(const World& world, uint32_t cell) const;
  FootprintPiece piece(const World& world, uint32_t cell) const;
  /// Barycentric coordinates of a cell's corners on its triangle.
  std::array<Vec2, 3> corners(uint32_t cell) const;
  /// Middle of a cell, seen from its side.
  SurfacePoint middle(const World& world, uint32_t cell) const;
};

/// One part for each side.
SurfaceParts whole_sides(const Scene& scene, const World& world);
/// @param mass   per side: its share of the parts (any scale)
/// @param count  of parts, about; every side that reflects has one
SurfaceParts make_parts(const Scene& scene, const World& world, std::span<const double> mass,
                        std::size_t count);
/// @param mass     per part: its share of the samples (any scale)
/// @param samples  about so many samples will be spread by mass; cells are a few times as many
SurfaceCells make_cells(const World& world, SurfaceParts parts, std::span<const double> mass,
                        std::size_t samples);

}  // namespace sconce
