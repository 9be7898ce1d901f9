// SPDX-License-Identifier: Apache-2.0
// A goniometer in software: what leaves a luminaire that is modelled as a scene, ray by ray, as a ray file
// would tell.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "light/lamp.h"
#include "photometry/rays.h"
#include "trace/tracer.h"

namespace sconce {

struct BenchParams {
  uint64_t rays = 4'000'000;  ///< that leave the lamps in the luminaire
  int reflections = 64;       ///< of one ray, at most
  uint32_t seed = 1;
};

/// Calls sink with blocks of the rays of all lamps, reflected by the luminaire's other parts until they leave
/// it: metals are mirrors about the interpolated normal, however rough; other surfaces are Lambertian. Flux
/// is luminance-weighted, in lm, and what is coloured keeps its colour; each lamp has rays in proportion to
/// its flux. A ray starts where it was last reflected. The luminaire hangs in its scene: nadir is -y, C0 +x,
/// C90 -z. The same bits in the same order at any number of threads; at most a million rays are held.
/// @throws Error: no lamp, or one at infinity
void trace_luminaire(const Scene& scene, const World& world, const Tracer& tracer, const Lamps& lamps,
                     const BenchParams& params, const std::function<void(std::span<const SourceRay>)>& sink,
                     const Progress& progress = {});

/// All of them at once, 40 bytes each.
std::vector<SourceRay> trace_luminaire(const Scene& scene, const World& world, const Tracer& tracer,
                                       const Lamps& lamps, const BenchParams& params,
                                       const Progress& progress = {});

}  // namespace sconce
