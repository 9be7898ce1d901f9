// SPDX-License-Identifier: Apache-2.0
// Laying patches flat.
#pragma once

#include <array>
#include <span>

#include "receive/charts.h"

namespace sconce {

/// A patch laid flat in metres: true area, wound as seen from the side it belongs to, no overlap.
struct Chart {
  Patch triangles;
  std::vector<std::array<Vec2, 3>> uv;  ///< per triangle, in the World's corner order
  bool back = false;                    ///< seen from behind: a twin
  float scale = 1;                      ///< linear texel density relative to the atlas's
  double area = 0;                      ///< m2
  double stretch = 1;                   ///< L2 stretch (Sander et al. 2001), 1 = isometric
  Vec2 size{0};                         ///< extent in metres; uv starts at (0, 0)

  /// Moves uv to the origin and sets size.
  void settle();
};

/// Planar projection where that is nearly true, least squares conformal maps elsewhere; a patch that folds
/// over, overlaps itself or is stretched too much is halved and tried again. Appends at least one chart.
void parameterize(const World& world, const MeshGraph& graph, const Patch& patch, std::vector<Chart>& charts);

/// L2 stretch of a chart, whatever its scale: root mean square of the singular values from texture to
/// surface, times the root of the ratio of areas.
double l2_stretch(const World& world, const MeshGraph& graph, const Chart& chart);

/// The same chart as seen from behind.
Chart make_twin(const Chart& chart);

/// A patch's corners joined across its inner edges.
struct PatchMesh {
  std::vector<std::array<uint32_t, 3>> corners;  ///< per triangle of the patch
  std::vector<Vec3> positions;
};
PatchMesh make_patch_mesh(const World& world, const MeshGraph& graph, const Patch& patch);

/// Least squares conformal map (Levy et al. 2002) with the two farthest vertices pinned. Empty when it has no
/// solution.
std::vector<Vec2> conformal_map(const PatchMesh& mesh);

/// Whether two triangles cover the same place, measured on a grid of sample points; neighbours never count.
bool overlaps_itself(std::span<const std::array<Vec2, 3>> triangles);

/// Turned so that the rectangle around it is the smallest, wider than high.
void turn_to_smallest_rectangle(std::vector<std::array<Vec2, 3>>& uv);

inline float cross2(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
inline float signed_area(const std::array<Vec2, 3>& t) {
  return 0.5f * cross2(t[1] - t[0], t[2] - t[0]);
}

}  // namespace sconce
