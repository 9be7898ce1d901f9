// SPDX-License-Identifier: Apache-2.0
// What can be seen: probe paths from cameras and lamps, counted per side of each triangle.
#pragma once

#include "core/progress.h"
#include "receive/parameterize.h"
#include "trace/tracer.h"

namespace sconce {

struct Visibility {
  std::vector<uint32_t> hits;  ///< per side (2 * triangle + 1 for the back): weighted path vertices
  double reference = 1;        ///< hits per m2 of an ordinary surface

  /// Hits per m2 of these triangles' side, relative to an ordinary surface.
  double relative(const MeshGraph& graph, const Patch& patch, bool back) const;
};

/// About a million path vertices: camera rays over every picture and rays from lamps, each with three diffuse
/// bounces. Where a scene has neither, everything counts as seen. The same for any number of threads.
Visibility probe_visibility(const Scene& scene, const World& world, const MeshGraph& graph,
                            const Tracer& tracer, uint32_t seed, const Progress& progress);

/// Linear density scale: 1 down to a tenth of an ordinary surface's hits per m2, from there falling with the
/// square root. Patches too small to tell are given the benefit of the doubt.
float density_scale(const Visibility& seen, const MeshGraph& graph, const Patch& patch, bool back,
                    float least);

/// Whether a patch's back is reached, other than by stray rays through cracks.
bool back_is_reached(const Visibility& seen, const MeshGraph& graph, const Patch& patch);

/// Per triangle 1 where it is large enough to know that nobody sees it.
std::vector<uint8_t> unseen_triangles(const Visibility& seen, const MeshGraph& graph);

}  // namespace sconce
