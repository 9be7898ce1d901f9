// SPDX-License-Identifier: Apache-2.0
#include "solve/shadow_rates.h"

#include <bit>

#include "core/sobol.h"

namespace sconce {

namespace {

constexpr std::size_t kAtFirst = 16;  // shadow rays of a sample before anything is known
constexpr double kLeastSeen = 8;      // samples that tell something
// A receiver's own ray costs some four shadow rays and brings light that varies with the lamp's usual light.
// The least product of cost and variance, summed over groups, is then where a lamp's samples for a ray are
// in proportion to its standard deviation in its usual light and to the root of 1 / lamps. By bench/groups.
constexpr double kWorth = 16;

}  // namespace

std::vector<double> usual_light(const World& world, const Tracer& tracer, const Lamps& lamps) {
  constexpr uint32_t kParticles = 256;
  constexpr float kGrazing = 1e-3f;
  std::vector<double> usual;
  if (lamps.size() > ShadowRates::kMostLamps) return usual;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    double met = 0, areas = 0;  // particles; what each stands for, for one lumen
    for (uint32_t p = 0; p < kParticles; ++p) {
      Sampler sampler(0x73686164u, static_cast<uint32_t>(i), p);
      const Vec2 where = sampler.next();
      const EmittedLight light = lamps.emit(i, where, sampler.next());
      const Vec3 start = light.normal == Vec3(0) ? light.position
                                                 : offset_origin(light.position, light.normal, light.normal);
      const Hit hit = tracer.follow({start, light.direction}, [&] { return sampler.next().x; }).hit;
      if (!hit) continue;
      const SurfacePoint at = surface_point(world, hit);
      LightSample sample;
      if (!lamps.sample(i, at.position, sampler.next(), sample)) continue;
      const float cosine = glm::dot(sample.direction, at.shading_normal);
      if (!(cosine > kGrazing)) continue;
      met += 1;
      areas += 1 / static_cast<double>(unit_light(sample, cosine));
    }
    usual.push_back(met / std::max(areas, 1e-30));
  }
  return usual;
}

ShadowRates::ShadowRates(std::span<const double> usual) {
  const auto more = static_cast<uint32_t>((usual.size() + kAtFirst - 1) / kAtFirst);
  const uint32_t level = kOne + (more > 1 ? static_cast<uint32_t>(std::bit_width(more - 1)) : 0);
  for (const double light : usual) lamps_.push_back({light, level});
}

void ShadowRates::decide(uint32_t first, uint32_t count) {
  first_ = first;
  count_ = count;
  for (uint32_t l = 0; l < kLevels; ++l)
    rates_[l] = static_cast<float>(this->count(l)) / static_cast<float>(count);
  const uint32_t last = std::min<uint32_t>(kLevels, std::bit_width(count << kOne)) - 1;  // none has no sample
  const double worth = kWorth / static_cast<double>(lamps_.size());
  for (Seen& lamp : lamps_) {
    if (lamp.count >= kLeastSeen) {
      const double n = lamp.count, light = lamp.light / n, mean = lamp.sum / n;
      // That all or none came through tells little after few: rule of succession.
      const double doubt = 0.5 / (n + 1);
      const double variance =
          std::max(0.0, lamp.squares / n - mean * mean) * n / (n - 1) + light * light * doubt * (1 - doubt);
      // Squared rates, halfway between the levels' own.
      double least = 1 << (2 * kOne - 1);
      for (lamp.level = 0; lamp.level + 1 < kLevels && worth * variance <= least * lamp.usual * lamp.usual;
           least /= 4)
        ++lamp.level;
    }
    lamp.level = std::min(lamp.level, last);
  }
}

}  // namespace sconce
