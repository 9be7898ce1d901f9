// SPDX-License-Identifier: Apache-2.0
// The rays that rows of transport matrices are made of.
#pragma once

#include "core/sobol.h"
#include "gather/cloud.h"

namespace sconce {

/// Follows a cosine-distributed ray from a receiver's point to the sample that speaks for where it ends.
/// Where none does it goes on, as a path: without colour, its length by the albedos' mean.
/// @param r       number of the ray, with pair 0 of `stream` already used for `at`
/// @param passed  called at every end, before the ray goes on, with (point, cell, step, throughput to its
/// reflected light)
/// @return nothing where light is lost: out of the scene, onto a black back, absorbed
template <class Passed>
std::optional<uint32_t> follow_row_ray(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                       SurfacePoint at, uint32_t r, uint32_t stream, Passed&& passed) {
  constexpr uint32_t kMostSteps = 8;
  Rgb throughput{1.0f};
  for (uint32_t step = 0; step < kMostSteps; ++step) {
    const Vec3 direction =
        Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(r, 1 + 2 * step, stream)));
    if (!(glm::dot(direction, at.geometric_normal) > 0)) return std::nullopt;
    const Hit hit = tracer.closest({offset_origin(at.position, at.geometric_normal, direction), direction});
    if (!hit || !cloud.reflects(hit)) return std::nullopt;
    const uint32_t cell = cloud.cell(hit);
    at = surface_point(world, hit);
    const Rgb& albedo = cloud.cell_albedo(cell);
    passed(at, cell, step, throughput * albedo);
    if (const auto sample = cloud.speaker(at, cell)) return sample;
    const float survival = (albedo.r + albedo.g + albedo.b) / 3;
    if (!(sobol_pair(r, 2 + 2 * step, stream).x < survival)) return std::nullopt;
    throughput *= albedo * (1 / survival);
  }
  return std::nullopt;
}

}  // namespace sconce
