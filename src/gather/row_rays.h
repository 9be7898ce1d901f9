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

/// A ray of a row on its way through panes.
inline Passage follow_row_panes(const Tracer& tracer, const Ray& ray, uint32_t r, uint32_t step,
                                uint32_t stream) {
  constexpr uint32_t kPanePair = 64;  // pairs that no step of a ray uses
  return tracer.follow(ray, [&] { return sobol_pair(r, kPanePair + step, stream).x; });
}

/// The sample that speaks for where a ray of a row ended.
struct RowEnd {
  uint32_t sample;
  Rgb tint;  ///< of the panes on the way
};

/// Follows a ray from its first hit to the sample that speaks for where it ends. Where none does it goes on,
/// as a path: without colour, its length by the albedos' mean.
/// @param passed  called at every end, before the ray goes on, with (point, cell, step, throughput to its
/// reflected light)
/// @return the sample and what panes on the way let through; nothing where light is lost: out of the scene,
/// onto a black back, absorbed
template <class Passed>
std::optional<RowEnd> follow_row_hit(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                     Passage met, uint32_t r, uint32_t stream, Passed&& passed) {
  constexpr uint32_t kMostSteps = 8;
  Rgb throughput{1.0f}, tint{1.0f};
  for (uint32_t step = 0; step < kMostSteps; ++step) {
    const Hit& hit = met.hit;
    if (!hit || !cloud.reflects(hit)) return std::nullopt;
    tint *= met.factor;
    throughput *= met.factor;
    const uint32_t cell = cloud.cell(hit);
    const SurfacePoint at = surface_point(world, hit);
    const Rgb& albedo = cloud.cell_albedo(cell);
    passed(at, cell, step, throughput * albedo);
    if (const auto sample = cloud.speaker(at, cell)) return RowEnd{*sample, tint};
    const float survival = (albedo.r + albedo.g + albedo.b) / 3;
    if (!(sobol_pair(r, 2 + 2 * step, stream).x < survival)) return std::nullopt;
    throughput *= albedo * (1 / survival);
    const auto ray = row_ray(at, r, step + 1, stream);
    if (!ray) return std::nullopt;
    met = follow_row_panes(tracer, *ray, r, step + 1, stream);
  }
  return std::nullopt;
}

/// The same from a receiver's point.
/// @param r  number of the ray, with pair 0 of `stream` already used for `at`
template <class Passed>
std::optional<RowEnd> follow_row_ray(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                     const SurfacePoint& at, uint32_t r, uint32_t stream, Passed&& passed) {
  const auto ray = row_ray(at, r, 0, stream);
  if (!ray) return std::nullopt;
  return follow_row_hit(world, tracer, cloud, follow_row_panes(tracer, *ray, r, 0, stream), r, stream,
                        std::forward<Passed>(passed));
}

}  // namespace sconce
