// SPDX-License-Identifier: Apache-2.0
// Where the gather rays of a bake will land: what the gather cloud should resolve.
#pragma once

#include <vector>

#include "receive/atlas.h"

namespace sconce {

/// Share of each side (gather/cells.h) in the hits of cosine-distributed rays from random receivers; one in
/// five counts the rays' next bounce, and a tenth goes by area, so that nothing is left out.
/// @return per side, sum 1; 0 where a side does not reflect
std::vector<double> visit_shares(const Scene& scene, const World& world, const Tracer& tracer,
                                 const TexelReceivers& receivers, std::size_t rays, uint32_t seed);

}  // namespace sconce
