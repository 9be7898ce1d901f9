// SPDX-License-Identifier: Apache-2.0
#include "gather/visits.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/cells.h"

namespace sconce {

namespace {

// Of the samples; the rest goes by area alone.
constexpr double kBySight = 0.5, kByLight = 0.4;
constexpr uint32_t kFirst = 4, kSecond = 1;

/// Hits of rays, by part.
class Visits {
 public:
  Visits(const World& world, const Tracer& tracer, const SurfaceParts& parts)
      : world_(world), tracer_(tracer), parts_(parts), hits_(parts.size(), 0) {}

  /// Follows a ray to its first hit and on to a second; whole numbers, so that any order gives the same sums.
  void follow(Ray ray, Sampler& sampler) {
    for (const uint32_t weight : {kFirst, kSecond}) {
      const Hit hit = tracer_.follow(ray, [&] { return sampler.next().x; }).hit;
      if (!hit) return;
      const uint32_t side = side_index(hit.triangle, hit.back);
      if (!parts_.reflects(side)) return;
      Vec2 local;
      std::atomic_ref(hits_[parts_.at(side, hit.barycentric, local)])
          .fetch_add(weight, std::memory_order_relaxed);
      ray = leave(surface_point(world_, hit), sampler);
      if (ray.direction == Vec3(0)) return;
    }
  }
  /// A cosine-distributed ray, or none: direction zero.
  static Ray leave(const SurfacePoint& at, Sampler& sampler) {
    const Vec3 direction = Frame(at.shading_normal).to_world(square_to_cosine(sampler.next()));
    if (!(glm::dot(direction, at.geometric_normal) > 0)) return {Vec3(0), Vec3(0)};
    return {offset_origin(at.position, at.geometric_normal, direction), direction};
  }
  /// Adds what other ranks have met.
  void join(const Ranks& ranks) {
    if (ranks.count == 1) return;
    std::string mine;
    put_span<uint64_t>(mine, hits_);
    std::fill(hits_.begin(), hits_.end(), 0);
    std::vector<uint64_t> one(hits_.size());
    for (const std::string& bytes : ranks.allgather(mine)) {
      std::string_view left = bytes;
      take_span<uint64_t>(left, one);
      for (std::size_t p = 0; p < hits_.size(); ++p) hits_[p] += one[p];
    }
  }
  /// Adds `share` of the samples, spread as the hits; false where nothing was hit.
  bool add(double share, std::vector<double>& shares) const {
    double count = 0;
    for (const uint64_t hits : hits_) count += static_cast<double>(hits);
    if (!(count > 0)) return false;
    for (std::size_t p = 0; p < shares.size(); ++p)
      shares[p] += share * static_cast<double>(hits_[p]) / count;
    return true;
  }

 private:
  const World& world_;
  const Tracer& tracer_;
  const SurfaceParts& parts_;
  std::vector<uint64_t> hits_;
};

}  // namespace

std::vector<double> visit_shares(const World& world, const Tracer& tracer, const Lamps& lamps,
                                 const ReceiverSource& receivers, const SurfaceParts& parts, std::size_t rays,
                                 uint32_t seed, const Progress& progress, const Ranks& ranks) {
  constexpr std::size_t kGrain = 1024;
  std::vector<double> shares(parts.size(), 0.0);
  std::atomic<uint64_t> begun = 0;
  const uint64_t blocks =
      ((receivers.count > 0 ? 1 : 0) + (lamps.size() > 0 ? 1 : 0)) * ((rays + kGrain - 1) / kGrain);
  const auto begin = [&](std::size_t i) {
    if (i % kGrain != 0) return;
    progress.check();
    progress.at("gather visits", begun++, blocks);
  };
  double rest = 1;
  if (receivers.count > 0) {
    Visits visits(world, tracer, parts);
    parallel_for(rays, kGrain, [&](std::size_t i) {
      begin(i);
      if (!ranks.mine(i / kGrain)) return;
      Sampler sampler(seed, 0x76697369u, static_cast<uint32_t>(i));
      const auto pick = static_cast<std::size_t>(static_cast<double>(i) / static_cast<double>(rays) *
                                                 static_cast<double>(receivers.count));
      const Ray ray = Visits::leave(receivers.footprint(pick).sample(sampler.next()), sampler);
      if (ray.direction != Vec3(0)) visits.follow(ray, sampler);
    });
    visits.join(ranks);
    const double share = lamps.size() > 0 ? kBySight : kBySight + kByLight;
    if (visits.add(share, shares)) rest -= share;
  }
  if (lamps.size() > 0) {
    Visits visits(world, tracer, parts);
    parallel_for(rays, kGrain, [&](std::size_t i) {
      begin(i);
      if (!ranks.mine(i / kGrain)) return;
      Sampler sampler(seed, 0x6c616d70u, static_cast<uint32_t>(i));
      const Vec2 where = sampler.next();
      const EmittedLight light = lamps.emit(i % lamps.size(), where, sampler.next());
      const bool surface = light.normal != Vec3(0);
      visits.follow({surface ? offset_origin(light.position, light.normal, light.normal) : light.position,
                     light.direction},
                    sampler);
    });
    visits.join(ranks);
    if (visits.add(kByLight, shares)) rest -= kByLight;
  }
  double total = 0;
  for (uint32_t p = 0; p < parts.size(); ++p) total += parts.area(world, p);
  for (uint32_t p = 0; p < parts.size(); ++p)
    shares[p] += rest * parts.area(world, p) / std::max(total, 1e-30);
  return shares;
}

}  // namespace sconce
