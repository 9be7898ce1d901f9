// SPDX-License-Identifier: Apache-2.0
// How much of each sample's radiosity reaches each sample: the kernel K, and all bounces through it.
#pragma once

#include <functional>

#include "gather/cloud.h"
#include "transfer/sparse_rows.h"

namespace sconce {

/// What the samples gather.
struct Gathered {
  /// K_ij = share of the rays of i that end on j. Scalar: albedo stays outside. Row sums are the covered
  /// share of the hemisphere.
  SparseRows rows;
  /// Illuminance after one reflection, samples x 3 groups, lux: from the light on cells, which are finer than
  /// samples, so that small bright spots stay where they are. By way of points for which no sample speaks (K
  /// does not know them) it may be more reflections.
  std::vector<float> once;
};

/// Adds an estimate of direct light at a point to 3 x groups sums, lux; `stream` names its random numbers.
using DirectAtPoint = std::function<void(const SurfacePoint&, uint32_t stream, std::span<double> sums)>;

/// Direct light where row rays end.
struct DirectLight {
  std::size_t groups = 0;
  std::span<const float> on_cells;  ///< cells x 3 groups, lux; read where Trust is whole
  /// One for each thread at a time; asked where cells are in part out of sight, since no ray ends on their
  /// dark, hidden part.
  std::function<DirectAtPoint()> make_at_point;
};

/// Rows of K by cosine-distributed rays from all over a sample's cells (methods.md 2.4, "hemisphere
/// gathering").
/// @param direct  groups = 0: rows only
Gathered gather(const World& world, const Tracer& tracer, const GatherCloud& cloud, int rays, uint32_t seed,
                const DirectLight& direct, const Progress& progress = {});

/// Number of bounces after which all light still to come is less than `tolerance` of what started, were it
/// even: a property of the scene alone, so that no lamp's result depends on another lamp. A mean over
/// samples, not over area: they are where light is looked for.
int enough_bounces(const SparseRows& rows, const GatherCloud& cloud, double tolerance = 1e-3);

/// Illuminance on the samples by light that was reflected 1 to `bounces` times: E = E_once + K (rho E), by
/// Jacobi sweeps, all groups at once.
/// @param once  samples x 3 groups, lux
/// @return as `once`, and for no bounces black
std::vector<float> bounce(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> once,
                          int bounces, const Progress& progress = {});

}  // namespace sconce
