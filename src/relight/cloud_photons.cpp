// SPDX-License-Identifier: Apache-2.0
#include "relight/cloud_photons.h"

#include "core/parallel.h"
#include "gather/row_rays.h"

namespace sconce {

CloudPhotons::CloudPhotons(const TracedScene& traced, const GatherCloud& cloud, const CloudSquare& square,
                           std::size_t photons, uint32_t seed, const Progress& progress) {
  const std::size_t slots = square.samples.size();
  std::vector<double> before{0};  // area of the slots before each
  for (const uint32_t sample : square.samples)
    before.push_back(before.back() +
                     static_cast<double>(cloud.area(sample)) / static_cast<double>(square.of(sample).size()));
  const double per_area = static_cast<double>(photons) / before.back();
  area_ = static_cast<float>(1 / per_area);

  constexpr std::size_t kBlock = 256;
  constexpr uint32_t kMostLandings = 64;
  std::vector<std::vector<Landing>> parts((slots + kBlock - 1) / kBlock);
  parallel_for(parts.size(), 1, [&](std::size_t part) {
    progress.check();
    for (std::size_t slot = kBlock * part; slot < std::min(slots, kBlock * (part + 1)); ++slot) {
      const uint32_t sample = square.samples[slot];
      const Footprint footprint = cloud.footprint(sample);
      const uint32_t stream = mix32(mix32(seed, 0x70686f74u), static_cast<uint32_t>(slot));
      // Whole numbers whose sum over any run of slots is the run's share.
      const auto count = static_cast<uint32_t>(std::floor(before[slot + 1] * per_area) -
                                               std::floor(before[slot] * per_area));
      for (uint32_t r = 0; r < count; ++r) {
        auto ray = row_ray(cloud.point(sample, footprint, sobol_pair(r, 0, stream)), r, 0, stream);
        Rgb throughput{1.0f};
        for (uint32_t landed = 0; ray && landed < kMostLandings; ++landed) {
          const Hit hit = traced.tracer.closest(*ray);
          if (!hit || !cloud.reflects(hit)) break;
          const SurfacePoint at = surface_point(traced.world, hit);
          Landing landing{at.position, {}, static_cast<uint32_t>(slot), throughput};
          for (int c = 0; c < 3; ++c)
            landing.normal[c] = static_cast<int8_t>(std::lround(127 * at.geometric_normal[c]));
          parts[part].push_back(landing);
          throughput *= cloud.cell_albedo(cloud.cell(hit));
          const float survival = std::min(1.0f, throughput.max());
          if (!(sobol_pair(r, 2 + 2 * landed, stream).x < survival)) break;
          throughput *= 1 / survival;
          ray = row_ray(at, r, landed + 1, stream);
        }
      }
    }
  });
  for (std::vector<Landing>& part : parts) {
    landings_.insert(landings_.end(), part.begin(), part.end());
    part = {};
  }
  for (std::size_t t = 0; t < traced.world.size(); ++t) scene_area_ += traced.world.area(t);
  tree_ = std::make_unique<PhotonTree<Landing>>(landings_);
}

Rgb CloudPhotons::row(const SurfacePoint& at, std::size_t nearest, std::vector<SparseEntry>& row) const {
  row.clear();
  NearPhotons near;
  // Twice the radius that they would have were all spread evenly.
  const float reach = 2 * std::sqrt(static_cast<float>(nearest) * scene_area_ * kInvPi /
                                    static_cast<float>(std::max<std::size_t>(1, landings_.size())));
  const float radius = tree_->nearest(
      {at.position, at.geometric_normal, nearest, reach}, [](const Landing&) { return true; }, near);
  std::sort(near.begin(), near.end(), [&](const auto& a, const auto& b) {
    return std::pair(landings_[a.second].slot, a.second) < std::pair(landings_[b.second].slot, b.second);
  });
  const float weight = area_ / (kPi * radius * radius);
  Rgb sum;
  for (const auto& [distance2, i] : near) {
    const Landing& landing = landings_[i];
    const Rgb& t = landing.throughput;
    if (row.empty() || row.back().index != landing.slot) row.push_back({landing.slot, 0});
    row.back().value += weight * (t.r + t.g + t.b) / 3;
    sum += t;
  }
  const float mean = (sum.r + sum.g + sum.b) / 3;
  return mean > 0 ? sum * (1 / mean) : Rgb(1);
}

}  // namespace sconce
