// SPDX-License-Identifier: Apache-2.0
// What can be seen: probe paths from cameras and lamps, counted per side of each triangle.
#pragma once

#include "core/progress.h"
#include "receive/parameterize.h"
#include "trace/tracer.h"

namespace sconce {

struct Visibility {
  /// A path's vertex on a side of a triangle.
  struct Visit {
    uint32_t side;  ///< 2 * triangle + 1 for the back
    uint32_t weight;
    uint64_t cell;  ///< cube of space it lies in
  };
  std::vector<Visit> visits;    ///< by side, then by cell, each pair once
  std::vector<uint32_t> first;  ///< per side: its range of visits, one more than sides
  double reference = 1;         ///< weight per m2 of an ordinary surface
  double cell_area = 1;         ///< m2 that a surface has in a cell, about

  uint64_t weight(uint32_t side) const;
};

/// About a million path vertices: camera rays over every picture and rays from lamps, each with three diffuse
/// bounces. Where a scene has neither, everything counts as seen. The same for any number of threads.
Visibility probe_visibility(const Scene& scene, const World& world, const MeshGraph& graph,
                            const Tracer& tracer, uint32_t seed, const Progress& progress);

/// Linear density scale: what the seen part of the patch needs, 1 down to a tenth of an ordinary surface's
/// visits per m2, from there falling with the square root; less where the seen part is only a small share of
/// the patch, so that no more than some 30 texels are spent per seen one. Patches too small to tell are given
/// the benefit of the doubt.
float density_scale(const Visibility& seen, const MeshGraph& graph, const Patch& patch, bool back,
                    float least);

/// Per triangle of the patch how much it is looked at: visits per m2 over those of an ordinary surface. Where
/// so few are expected that their number says little it is the patch's mean.
std::vector<double> importances(const Visibility& seen, const MeshGraph& graph, const Patch& patch,
                                bool back);

/// Whether any probe ray reached the patch's side.
bool is_reached(const Visibility& seen, const Patch& patch, bool back);

/// Whether a patch's back is reached, other than by stray rays through cracks.
bool back_is_reached(const Visibility& seen, const MeshGraph& graph, const Patch& patch);

/// Per triangle 1 where it is large enough to know that nobody sees it.
std::vector<uint8_t> unseen_triangles(const Visibility& seen, const MeshGraph& graph);

}  // namespace sconce
