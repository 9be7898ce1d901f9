// SPDX-License-Identifier: Apache-2.0
#include "relight/training_lights.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kStream = 0x74726169u;
constexpr float kNearest =
    0.03f;  // to where the ray began, diagonals: closer lamps light little but one spot

/// A point, or a spot where the cone is narrower.
struct TrainingLamp {
  Vec3 position, axis;
  float cosine = -1;
};

TrainingLamp random_lamp(const TracedScene& traced, const RelightReceivers& receivers,
                         std::span<const SurfacePoint> middles, uint32_t number, uint32_t seed) {
  const float diagonal = traced.world.bounds.diagonal();
  TrainingLamp lamp;
  Sampler sampler(seed, kStream, number);
  for (int tries = 0; tries < 16; ++tries) {
    const Vec2 pick = sampler.next(), along = sampler.next(), aim = sampler.next(), shape = sampler.next();
    const SurfacePoint& from = middles[static_cast<std::size_t>(pick.x * static_cast<float>(middles.size()))];
    Vec3 direction = Frame(from.geometric_normal).to_world(square_to_cosine(along));
    float distance = 0;
    if (receivers.kind == OperatorReceivers::pixels) {
      const Vec3 to_eye = Vec3(receivers.camera.frame[3]) - from.position;
      distance = glm::length(to_eye), direction = normalize_or(to_eye, from.geometric_normal);
    } else {
      distance =
          traced.tracer.closest({offset_origin(from.position, from.geometric_normal, direction), direction})
              .distance;
    }
    lamp.position = from.position + (0.15f + 0.7f * pick.y) * distance * direction;
    lamp.axis = Frame(-direction).to_world(square_to_cosine(aim));
    lamp.cosine = number % 2 == 0 ? -1 : 0.6f + 0.36f * shape.x;
    if (distance > kNearest * diagonal) break;
  }
  return lamp;
}

}  // namespace

std::vector<std::vector<Rgbx>> training_lights(const TracedScene& traced, const RelightReceivers& receivers,
                                               std::span<const SurfacePoint> middles, const Operator& op,
                                               int count, uint32_t seed, const Progress& progress) {
  const std::size_t slots = op.lit.size() / op.points_per_slot;
  const float least = kNearest * traced.world.bounds.diagonal();
  std::vector<std::vector<Rgbx>> lights(static_cast<std::size_t>(count));
  std::atomic<uint64_t> done = 0;
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    progress.check();
    const TrainingLamp lamp = random_lamp(traced, receivers, middles, static_cast<uint32_t>(t), seed);
    std::vector<Rgbx>& light = lights[t];
    light.assign(slots, Rgbx{});
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const OperatorPoint& p = op.lit[op.points_per_slot * slot + t % op.points_per_slot];
      const Vec3 at(p.position[0], p.position[1], p.position[2]);
      const float distance = glm::distance(at, lamp.position);
      if (!(distance > 0)) continue;
      const Vec3 to = (lamp.position - at) / distance, normal = unpack_normal(p.geometric);
      const float cosine = glm::dot(to, unpack_normal(p.shading));
      if (!(cosine > 0) || !(glm::dot(to, normal) > 0) || glm::dot(-to, lamp.axis) < lamp.cosine) continue;
      if (traced.tracer.occluded({offset_origin(at, normal, normal), to, distance})) continue;
      const Rgb b = unpack_albedo(p.albedo) * (cosine / std::max(distance * distance, least * least));
      light[slot] = {b.r, b.g, b.b, 0};
    }
    progress.at("training lights", ++done, lights.size());
  });
  return lights;
}

}  // namespace sconce
