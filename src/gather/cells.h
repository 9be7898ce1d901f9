// SPDX-License-Identifier: Apache-2.0
// The reflecting surface cut into small cells: what a ray's hit falls into without any search.
#pragma once

#include <span>
#include <vector>

#include "core/receiver.h"
#include "scene/world.h"

namespace sconce {

/// A side of a triangle: 2 x triangle, + 1 for its back.
constexpr uint32_t side_index(uint32_t triangle, bool back) {
  return 2 * triangle + (back ? 1 : 0);
}

/// Cells of all sides that reflect: fronts, and backs of double-sided materials. Cells of a side are equal.
struct SurfaceCells {
  std::vector<uint32_t> first;  ///< per side and one more
  std::vector<uint16_t> cut;    ///< per triangle: each side has cut x cut cells
  std::vector<uint32_t> sides;  ///< per cell

  std::size_t size() const { return sides.size(); }
  /// Cell that a point lies in; only for sides that have cells.
  uint32_t at(uint32_t side, Vec2 barycentric) const;
  bool reflects(uint32_t side) const { return first[side] != first[side + 1]; }
  /// m2
  float area(const World& world, uint32_t cell) const;
  FootprintPiece piece(const World& world, uint32_t cell) const;
  /// Barycentric coordinates of a cell's corners on its triangle.
  std::array<Vec2, 3> corners(uint32_t cell) const;
  /// Middle of a cell, seen from its side.
  SurfacePoint middle(const World& world, uint32_t cell) const;
};

/// @param mass     per side: its share of the samples (any scale); 0 where it does not reflect
/// @param samples  about so many samples will be spread by mass; cells are a few times as many
SurfaceCells make_cells(const Scene& scene, const World& world, std::span<const double> mass,
                        std::size_t samples);

/// Area of each side that reflects, m2; 0 for the others.
std::vector<double> side_areas(const Scene& scene, const World& world);

}  // namespace sconce
