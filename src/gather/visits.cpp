// SPDX-License-Identifier: Apache-2.0
#include "gather/visits.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/cells.h"

namespace sconce {

namespace {

constexpr double kByArea = 0.1;  // share of the samples that goes by area alone
constexpr uint32_t kFirst = 4, kSecond = 1;

}  // namespace

std::vector<double> visit_shares(const Scene& scene, const World& world, const Tracer& tracer,
                                 const TexelReceivers& receivers, std::size_t rays, uint32_t seed) {
  std::vector<double> shares = side_areas(scene, world);
  std::vector<uint64_t> hits(shares.size(), 0);
  parallel_for(receivers.size() == 0 ? 0 : rays, 1024, [&](std::size_t i) {
    Sampler sampler(seed, 0x76697369u, static_cast<uint32_t>(i));
    const auto pick = static_cast<std::size_t>(static_cast<double>(i) / static_cast<double>(rays) *
                                               static_cast<double>(receivers.size()));
    SurfacePoint at = receivers.footprint(pick).sample(sampler.next());
    for (const uint32_t weight : {kFirst, kSecond}) {
      const Vec3 direction = Frame(at.shading_normal).to_world(square_to_cosine(sampler.next()));
      if (!(glm::dot(direction, at.geometric_normal) > 0)) return;
      const Hit hit = tracer.closest({offset_origin(at.position, at.geometric_normal, direction), direction});
      if (!hit || shares[side_index(hit.triangle, hit.back)] <= 0) return;
      std::atomic_ref(hits[side_index(hit.triangle, hit.back)]).fetch_add(weight, std::memory_order_relaxed);
      const float side = hit.back ? -1.0f : 1.0f;
      at = {world.position(hit.triangle, hit.barycentric), side * world.normal(hit.triangle, hit.barycentric),
            side * world.face_normals[hit.triangle]};
    }
  });
  double area = 0, count = 0;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    area += shares[s];
    count += static_cast<double>(hits[s]);
  }
  const double by_area = count > 0 ? kByArea : 1;
  for (std::size_t s = 0; s < shares.size(); ++s)
    shares[s] =
        by_area * shares[s] / area + (count > 0 ? (1 - kByArea) * static_cast<double>(hits[s]) / count : 0.0);
  return shares;
}

}  // namespace sconce
