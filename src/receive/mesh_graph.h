// SPDX-License-Identifier: Apache-2.0
// Which triangles of a World touch along an edge, and how smoothly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/world.h"

namespace sconce {

/// Edge k of a triangle runs from its corner k to corner k+1; half-edge 3 * triangle + k names it.
struct MeshGraph {
  static constexpr uint32_t kNone = 0xffffffffu;

  /// Per half-edge: the half-edge on the other side, or kNone at borders, non-manifold edges and between
  /// instances.
  std::vector<uint32_t> mates;
  /// Per half-edge: cosine of the largest angle between the shading normals of its two sides; 1 = smooth.
  std::vector<float> turn;
  /// Per triangle: the face normal; where the triangle is too thin to have a reliable one, that of its
  /// corners.
  std::vector<Vec3> normals;
  std::vector<float> areas;  ///< m2

  std::size_t size() const { return normals.size(); }
};

/// Corners are joined where an instance's positions are equal bit by bit.
MeshGraph make_mesh_graph(const World& world);

/// The shading normal of corner k, unit, on the side of the face normal; the face normal where there is none.
Vec3 corner_normal(const World& world, std::size_t triangle, std::size_t k);

/// Half-edges around a triangle.
constexpr uint32_t next_corner(uint32_t k) {
  return k == 2 ? 0 : k + 1;
}

}  // namespace sconce
