// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solve/solver.h"

namespace sconce {

/// Two steps. First all bounces on a gather cloud: direct light of all groups on its samples, then the sparse
/// kernel K again and again. Then per receiver direct light exactly, by next-event estimation, and one ray
/// for all groups and all bounces: it reads the cached light where it ends. Rays shorter than twice the
/// cloud's spacing, and rays that end where no sample is sure to speak for the surface, go on as paths. The
/// error it states is the gather rays' noise; the cloud's own error is the same in all batches.
std::unique_ptr<Solver> make_radiosity_solver(const SolveContext& context, const BakeParams& params,
                                              const Progress& progress);

}  // namespace sconce
