// SPDX-License-Identifier: Apache-2.0
// To compare with: Keller's instant radiosity (1997) as Hrbek measured it, with rays for shadow maps, and
// paths that tell what is right. Light is in the renderer's unit, as in detect/realtime.h.
#pragma once

#include "core/parallel.h"
#include "core/sobol.h"
#include "detect/synthetic_host.h"
#include "relight/receivers.h"

namespace sconce {

/// A room lit by one point lamp.
struct LitRoom {
  const TracedScene& traced;
  std::span<const SyntheticMaterial> materials;  ///< reflectances
  SyntheticLamp lamp;
  float unit;  ///< SyntheticHost::unit

  const Rgb& reflectance(const Hit& hit) const {
    return materials[traced.world.materials[hit.triangle].value].response.reflectance;
  }
  /// What the lamp makes a surface reflect.
  Rgb shown(const Hit& hit, const SurfacePoint& at) const {
    const Vec3 to = lamp.position - at.position;
    const float distance = glm::length(to), cosine = glm::dot(to, at.shading_normal) / distance;
    if (cosine <= 0 || traced.tracer.occluded(
                           {offset_origin(at.position, at.geometric_normal, to), to / distance, distance}))
      return {};
    return reflectance(hit) * lamp.intensity * (unit * cosine / (distance * distance));
  }
};

/// Reflected light as a lamp on a surface: its intensity falls off with the cosine.
struct VirtualLight {
  SurfacePoint at;
  Rgb flux;
};

/// About `count` of them (methods.md 2.4): particles that go on with the probability of the mean reflectance,
/// one sample at each hit.
inline std::vector<VirtualLight> light_samples(const LitRoom& room, std::size_t count) {
  float mean = 0;
  for (const SyntheticMaterial& m : room.materials) mean += luminance(m.response.reflectance);
  mean /= static_cast<float>(room.materials.size());
  const auto particles = static_cast<uint32_t>(static_cast<float>(count) * (1 - mean));
  std::vector<VirtualLight> samples;
  for (uint32_t p = 0; p < particles; ++p) {
    Rgb flux = room.lamp.intensity * (4 * kPi * room.unit / static_cast<float>(particles));
    const Vec2 u = sobol_pair(p, 0, 1);
    const float z = 1 - 2 * u.x, s = std::sqrt(std::max(0.0f, 1 - z * z));
    Ray ray{room.lamp.position, Vec3(s * std::cos(2 * kPi * u.y), s * std::sin(2 * kPi * u.y), z)};
    for (uint32_t step = 1; step < 32; ++step) {
      const Hit hit = room.traced.tracer.closest(ray);
      if (!hit || hit.back) break;
      const SurfacePoint at = surface_point(room.traced.world, hit);
      flux *= room.reflectance(hit);
      samples.push_back({at, flux});
      if (sobol_pair(p, 2 * step, 1).x >= mean) break;
      flux *= 1 / mean;
      ray.direction = Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(p, 2 * step - 1, 1)));
      ray.origin = offset_origin(at.position, at.geometric_normal, ray.direction);
    }
  }
  return samples;
}

/// What points receive from light samples, a shadow ray each. No sample counts as nearer than `nearest`, m:
/// without it, corners have bright spots; with it, they lose light.
inline std::vector<Rgb> instant_radiosity(const Tracer& tracer, std::span<const VirtualLight> samples,
                                          std::span<const SurfacePoint> points, float nearest) {
  std::vector<Rgb> out(points.size());
  parallel_for(points.size(), 64, [&](std::size_t i) {
    const SurfacePoint& p = points[i];
    for (const VirtualLight& sample : samples) {
      const Vec3 to = sample.at.position - p.position;
      const float distance = glm::length(to);
      const float cosines = std::max(0.0f, glm::dot(to, p.shading_normal)) *
                            std::max(0.0f, -glm::dot(to, sample.at.shading_normal));
      if (!(cosines > 0)) continue;
      const Vec3 start = offset_origin(p.position, p.geometric_normal, to),
                 end = offset_origin(sample.at.position, sample.at.geometric_normal, -to);
      const float far = glm::distance(start, end);
      if (tracer.occluded({start, (end - start) / far, far})) continue;
      out[i] += sample.flux *
                (cosines / (kPi * distance * distance * std::max(distance * distance, nearest * nearest)));
    }
  });
  return out;
}

/// What receivers get by reflection, by paths. @param which  of the source's receivers
inline std::vector<Rgb> path_light(const LitRoom& room, const ReceiverSource& source,
                                   std::span<const std::size_t> which, uint32_t paths) {
  std::vector<Rgb> out(which.size());
  parallel_for(which.size(), 1, [&](std::size_t i) {
    const Footprint footprint = source.footprint(which[i]);
    const auto stream = static_cast<uint32_t>(which[i]);
    for (uint32_t path = 0; path < paths; ++path) {
      SurfacePoint at = footprint.sample(sobol_pair(path, 0, stream));
      Rgb throughput(1);
      for (uint32_t step = 1; step < 40; ++step) {
        const Vec3 direction =
            Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(path, 2 * step - 1, stream)));
        if (!(glm::dot(direction, at.geometric_normal) > 0)) break;
        const Hit hit = room.traced.tracer.closest(
            {offset_origin(at.position, at.geometric_normal, direction), direction});
        if (!hit || hit.back) break;
        at = surface_point(room.traced.world, hit);
        out[i] += throughput * room.shown(hit, at) / static_cast<float>(paths);
        const Rgb& rho = room.reflectance(hit);
        const float survival = step > 2 ? rho.max() : 1;
        if (sobol_pair(path, 2 * step, stream).x >= survival) break;
        throughput *= rho / survival;
      }
    }
  });
  return out;
}

}  // namespace sconce
