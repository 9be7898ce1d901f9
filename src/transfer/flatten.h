// SPDX-License-Identifier: Apache-2.0
// Points of surfaces brought into an order in which neighbours are alike: the cloud's samples as a square for
// wavelets, receivers as blocks that share coefficients.
#pragma once

#include <span>
#include <vector>

#include "core/receiver.h"

namespace sconce {

/// Halves the points again and again by balanced 2-means in (20 position, 16 diagonal x normal), down to
/// leaves; the system C chapter's flattening (Listing 9-2), exactly equal halves. Its weight of normals is a
/// sixteenth of ours, which leaves walls together with their backs up to a tenth of the scene's size: lit and
/// dark, and not to be told apart by few wavelets. For a power of four and leaves of 1 the result is a square
/// along its Z-order curve (haar.h), whose aligned blocks are alike.
/// @param leaf      all parts but the last are multiples of it; within leaves the order is by index
/// @param diagonal  of the scene's bounds, m
/// @return a permutation: which point stands at each place
std::vector<uint32_t> cluster_order(std::span<const SurfacePoint> points, std::size_t leaf, float diagonal);

}  // namespace sconce
