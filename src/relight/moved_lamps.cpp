// SPDX-License-Identifier: Apache-2.0
#include "relight/moved_lamps.h"

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kCloudStream = 0x636c6f64u;

Scene with(const Scene& scene, const std::vector<Light>& lights) {
  Scene out = scene;
  out.lights.insert(out.lights.end(), lights.begin(), lights.end());
  return out;
}

}  // namespace

MovedLamps::MovedLamps(const Scene& scene, const World& world, const Tracer& tracer,
                       const std::vector<Light>& lights, std::span<const MovedGroup> groups)
    : tracer_(tracer), scene_(with(scene, lights)), lamps_(scene_, world) {
  // Lamps are the scene's lights, in order, and then the emissive meshes.
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const bool added = i >= scene.lights.size() && i < scene_.lights.size();
    if (added) chosen_.push_back({i, Rgb(1)});
    for (const MovedGroup& moved : groups)
      if (!added && lamps_.all()[i].group == moved.group && !moved.weight.is_black())
        chosen_.push_back({i, moved.weight});
  }
}

Rgb MovedLamps::illuminance(const SurfacePoint& at, uint32_t stream, uint32_t index) const {
  Rgb sum;
  const Vec3 start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  // The lamp's own surface must not count as an occluder.
  const float clearance = 4 * glm::distance(start, at.position);
  for (const Chosen& chosen : chosen_) {
    LightSample light;
    const Vec2 u = sobol_pair(index, 0, mix32(stream, static_cast<uint32_t>(chosen.lamp)));
    if (!lamps_.sample(chosen.lamp, at.position, u, light) || light.radiance.is_black()) continue;
    const float cosine = glm::dot(light.direction, at.shading_normal);
    if (!(cosine > 0) || !(glm::dot(light.direction, at.geometric_normal) > 0)) continue;
    const float end = light.delta ? light.distance : light.distance * (1 - 1e-4f) - clearance;
    if (end > 0 && tracer_.occluded({start, light.direction, end})) continue;
    sum += chosen.weight * light.radiance * (light.delta ? cosine : cosine / light.pdf);
  }
  return sum;
}

std::vector<Rgbx> light_cloud(const Operator& op, const MovedLamps& lamps) {
  std::vector<Rgbx> exitance(op.slots());
  const uint32_t points = op.points_per_slot;
  parallel_for(exitance.size(), 256, [&](std::size_t slot) {
    Rgb sum;
    for (uint32_t p = 0; p < points; ++p) {
      const OperatorPoint& point = op.lit[points * slot + p];
      const SurfacePoint at{Vec3(point.position[0], point.position[1], point.position[2]),
                            unpack_normal(point.shading), unpack_normal(point.geometric)};
      sum += unpack_albedo(point.albedo) *
             lamps.illuminance(at, mix32(kCloudStream, static_cast<uint32_t>(slot)), p);
    }
    sum *= 1 / static_cast<float>(points);
    exitance[slot] = {sum.r, sum.g, sum.b, 0};
  });
  return exitance;
}

}  // namespace sconce
