// SPDX-License-Identifier: Apache-2.0
// Light at measuring planes and probes, by the path tracer whatever the solver of the lightmap: few points,
// and their figures are read as they stand.
#pragma once

#include "package/points.h"
#include "solve/solver.h"

namespace sconce {

/// Fills a plane's values for all groups.
/// @param params  seed, bounces, samples, noise: made better where a single figure needs it @throws Cancelled
void bake_plane(PlaneLight& plane, const SolveContext& context, const BakeParams& params,
                const Progress& progress);

/// Whether a point is in the open: most rays from inside of something meet backs that no one may see.
bool is_free(const SolveContext& context, const Vec3& position);

/// Probes over the scene's bounds, half a spacing (or the middle) away from its sides. Along an axis in which
/// the scene is flat they stand half a spacing before its surfaces, on both sides if those face both ways. A
/// probe whose rays mostly meet backs that no one may see is inside of something.
/// @param spacing  metres @throws UsageError for more than a million probes; Cancelled
ProbeGrid bake_probes(float spacing, const SolveContext& context, const BakeParams& params,
                      const Progress& progress);

}  // namespace sconce
