// SPDX-License-Identifier: Apache-2.0
// The rays that rows of transport matrices are made of.
#pragma once

#include "core/sobol.h"
#include "gather/cloud.h"

namespace sconce {

/// A cosine-distributed ray from a point of a surface. Nothing where it starts below the horizon.
/// @param step  how often light was reflected on the ray's way until here
inline std::optional<Ray> row_ray(const SurfacePoint& at, uint32_t r, uint32_t step, uint32_t stream) {
  const Vec3 direction =
      Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(r, 1 + 2 * step, stream)));
  if (!(glm::dot(direction, at.geometric_normal) > 0)) return std::nullopt;
  return Ray{offset_origin(at.position, at.geometric_normal, direction), direction};
}

/// Follows a ray from its first hit to the sample that speaks for where it ends. Where none does it goes on,
/// as a path: without colour, its length by the albedos' mean.
/// @param passed  called at every end, before the ray goes on, with (point, cell, step, throughput to its
/// reflected light)
/// @return nothing where light is lost: out of the scene, onto a black back, absorbed
template <class Passed>
std::optional<uint32_t> follow_row_hit(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                       Hit hit, uint32_t r, uint32_t stream, Passed&& passed) {
  constexpr uint32_t kMostSteps = 8;
  Rgb throughput{1.0f};
  for (uint32_t step = 0; step < kMostSteps; ++step) {
    if (!hit || !cloud.reflects(hit)) return std::nullopt;
    const uint32_t cell = cloud.cell(hit);
    const SurfacePoint at = surface_point(world, hit);
    const Rgb& albedo = cloud.cell_albedo(cell);
    passed(at, cell, step, throughput * albedo);
    if (const auto sample = cloud.speaker(at, cell)) return sample;
    const float survival = (albedo.r + albedo.g + albedo.b) / 3;
    if (!(sobol_pair(r, 2 + 2 * step, stream).x < survival)) return std::nullopt;
    throughput *= albedo * (1 / survival);
    const auto ray = row_ray(at, r, step + 1, stream);
    if (!ray) return std::nullopt;
    hit = tracer.closest(*ray);
  }
  return std::nullopt;
}

/// The same from a receiver's point.
/// @param r  number of the ray, with pair 0 of `stream` already used for `at`
template <class Passed>
std::optional<uint32_t> follow_row_ray(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                       const SurfacePoint& at, uint32_t r, uint32_t stream, Passed&& passed) {
  const auto ray = row_ray(at, r, 0, stream);
  if (!ray) return std::nullopt;
  return follow_row_hit(world, tracer, cloud, tracer.closest(*ray), r, stream, std::forward<Passed>(passed));
}

}  // namespace sconce
