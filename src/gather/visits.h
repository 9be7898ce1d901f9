// SPDX-License-Identifier: Apache-2.0
// Where light is looked for and where it lands: what the gather cloud should resolve.
#pragma once

#include <vector>

#include "core/progress.h"
#include "core/ranks.h"
#include "gather/cells.h"
#include "light/lamp.h"

namespace sconce {

/// Share of each part (gather/cells.h) in the samples: half by the hits of cosine-distributed rays from
/// random receivers (may be none), two fifths by the hits of light from the lamps, each lamp alike, whatever
/// its strength; one hit in five is one after a reflection. The rest, and all of it where there are neither,
/// goes by area, so that nothing is left out.
/// @param ranks  share the rays
/// @return per part, sum 1
std::vector<double> visit_shares(const World& world, const Tracer& tracer, const Lamps& lamps,
                                 const ReceiverSource& receivers, const SurfaceParts& parts, std::size_t rays,
                                 uint32_t seed, const Progress& progress, const Ranks& ranks);

}  // namespace sconce
