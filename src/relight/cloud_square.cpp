// SPDX-License-Identifier: Apache-2.0
#include "relight/cloud_square.h"

#include <algorithm>
#include <atomic>
#include <queue>

#include "core/error.h"
#include "core/parallel.h"
#include "gather/row_rays.h"
#include "transfer/flatten.h"

namespace sconce {

std::vector<uint8_t> seen_samples(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                  const ReceiverSource& receivers, uint32_t seed) {
  constexpr std::size_t kRays = 1 << 20;  // in all, half from receivers, half from samples
  std::vector<uint8_t> seen(cloud.size(), 0);
  const auto look = [&](std::size_t count, uint32_t salt, auto&& point) {
    const std::size_t each = std::max<std::size_t>(4, kRays / 2 / std::max<std::size_t>(1, count));
    parallel_for(count, 256, [&](std::size_t i) {
      const uint32_t stream = mix32(mix32(seed, salt), static_cast<uint32_t>(i));
      for (uint32_t r = 0; r < each; ++r) {
        const auto end = follow_row_ray(world, tracer, cloud, point(i, sobol_pair(r, 0, stream)), r, stream,
                                        [](const SurfacePoint&, uint32_t, uint32_t, const Rgb&) {});
        if (end) std::atomic_ref(seen[end->sample]).store(1, std::memory_order_relaxed);
      }
    });
  };
  look(receivers.count, 0x72656376u, [&](std::size_t i, Vec2 u) { return receivers.footprint(i).sample(u); });
  look(cloud.size(), 0x73616d70u,
       [&](std::size_t i, Vec2 u) { return cloud.point(i, cloud.footprint(i), u); });
  return seen;
}

CloudSquare make_cloud_square(const GatherCloud& cloud, std::size_t n, std::span<const uint8_t> seen,
                              float diagonal) {
  // Spare slots go one by one to the sample with the most area per slot.
  std::vector<uint32_t> counts(cloud.size(), 0);
  std::priority_queue<std::pair<float, uint32_t>> largest;
  const bool none = std::find(seen.begin(), seen.end(), 1) == seen.end();
  for (uint32_t i = 0; i < counts.size(); ++i)
    if (none || seen[i] != 0) {
      counts[i] = 1;
      largest.emplace(cloud.area(i), ~i);
    }
  for (std::size_t spare = n - largest.size(); spare > 0; --spare) {
    const uint32_t i = ~largest.top().second;
    largest.pop();
    ++counts[i];
    largest.emplace(cloud.area(i) / static_cast<float>(counts[i]), ~i);
  }
  std::vector<SurfacePoint> points;
  std::vector<std::pair<uint32_t, uint32_t>> copies;
  for (uint32_t i = 0; i < counts.size(); ++i) {
    const Footprint footprint = cloud.footprint(i);
    for (uint32_t c = 0; c < counts[i]; ++c) {
      points.push_back(cloud.point(i, footprint, sobol_pair(c, 0, mix32(0x736c6f74u, i))));
      copies.emplace_back(i, c);
    }
  }
  CloudSquare square;
  for (const uint32_t k : cluster_order(points, 1, diagonal)) {
    square.samples.push_back(copies[k].first);
    square.copies.push_back(copies[k].second);
  }
  square.first.push_back(0);
  for (const uint32_t count : counts) square.first.push_back(square.first.back() + count);
  square.slots.resize(n);
  for (uint32_t slot = 0; slot < n; ++slot)
    square.slots[square.first[square.samples[slot]] + square.copies[slot]] = slot;
  return square;
}

std::unique_ptr<GatherCloud> make_cloud_of(const Scene& scene, const World& world, const Tracer& tracer,
                                           const ReceiverSource& receivers, std::size_t n, uint32_t seed,
                                           const Progress& progress) {
  // Lamps will be anywhere, so none of today's may draw samples to itself.
  Scene unlit = scene;
  unlit.lights.clear();
  for (Material& material : unlit.materials) material.emission = Rgb(0);
  const Lamps none(unlit, world);
  constexpr int kTries = 6;
  auto wanted = static_cast<double>(n) * 0.95;
  for (int i = 0; i < kTries; ++i) {
    auto cloud = std::make_unique<GatherCloud>(scene, world, tracer, none, receivers,
                                               CloudParams{static_cast<std::size_t>(wanted), seed}, progress);
    if (cloud->size() <= n) return cloud;
    wanted *= 0.95 * static_cast<double>(n) / static_cast<double>(cloud->size());
    if (wanted < 1) break;
  }
  throw UsageError("option '--gather'",
                   "the surfaces of this scene need more than " + std::to_string(n) + " samples",
                   "a larger power of four, up to 65536");
}

}  // namespace sconce
