// SPDX-License-Identifier: Apache-2.0
// How much of each sample's radiosity reaches each sample: the kernel K, and all bounces through it.
#pragma once

#include "gather/cloud.h"
#include "transfer/sparse_rows.h"

namespace sconce {

/// Rows of K by cosine-distributed rays from all over a sample's cells: K_ij = share of the rays of i that
/// end on j (methods.md 2.4, "hemisphere gathering"). Scalar: albedo stays outside. Row sums are the covered
/// share of the hemisphere.
SparseRows make_rows(const Tracer& tracer, const GatherCloud& cloud, int rays, uint32_t seed,
                     const Progress& progress = {});

/// Number of bounces after which less than `tolerance` of any light is still under way: a property of the
/// scene alone, so that no lamp's result depends on another lamp.
int enough_bounces(const SparseRows& rows, const GatherCloud& cloud, double tolerance = 1e-4);

/// Illuminance on the samples after so many reflections: E = E_direct + K (rho E), by Jacobi sweeps, all
/// groups at once.
/// @param direct  samples x 3 groups, lux
std::vector<float> bounce(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> direct,
                          int bounces, const Progress& progress = {});

}  // namespace sconce
