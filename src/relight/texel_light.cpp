// SPDX-License-Identifier: Apache-2.0
#include "relight/texel_light.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kTexelStream = 0x74657865u, kMiddleStream = 0x6d696464u;
constexpr uint32_t kTexelRays = 32;  // per texel and lamp

}  // namespace

std::vector<Rgb> direct_at_middles(const Operator& op, const MovedLamps& lamps) {
  std::vector<Rgb> light(op.receivers.size());
  parallel_for(light.size(), 1024, [&](std::size_t i) {
    light[i] =
        lamps.illuminance(point_of(op.receivers[i]), mix32(kMiddleStream, static_cast<uint32_t>(i)), 0);
  });
  return light;
}

std::vector<Rgb> direct_over_texels(const Operator& op, const RelightReceivers& texels,
                                    const MovedLamps& lamps, const Progress& progress) {
  std::vector<Rgb> light(op.places.size());
  constexpr std::size_t kBlock = 1024;
  const std::size_t blocks = (light.size() + kBlock - 1) / kBlock;
  std::atomic<uint64_t> done = 0;
  parallel_for(blocks, 1, [&](std::size_t block) {
    progress.check();
    for (std::size_t i = kBlock * block; i < std::min(light.size(), kBlock * (block + 1)); ++i) {
      const auto at = std::lower_bound(texels.places.begin(), texels.places.end(), op.places[i]);
      if (at == texels.places.end() || *at != op.places[i]) continue;
      const Footprint texel = texels.source.footprint(static_cast<std::size_t>(at - texels.places.begin()));
      const uint32_t stream = mix32(kTexelStream, op.places[i]);
      Rgb sum;
      for (uint32_t r = 0; r < kTexelRays; ++r)
        sum += lamps.illuminance(texel.sample(sobol_pair(r, 0, stream)), ~stream, r);
      light[i] = sum * (1.0f / kTexelRays);
    }
    progress.at("light of lamps on texels", ++done, blocks);
  });
  return light;
}

std::vector<Rgb> with_indirect(std::vector<Rgb> direct, const Package& package, const View& view,
                               const Operator& op, const FoldedBounces& bounces, const MovedLamps& lamps) {
  const Relighter indirect(package, view, op, bounces, lamps);
  for (std::size_t i = 0; i < direct.size(); ++i) direct[i] += indirect.indirect()[i];
  return direct;
}

std::vector<Rgb> lightmap_share(const Package& package, const View& view, const Operator& op,
                                const FoldedBounces& bounces, const MovedLamps& lamps,
                                const Progress& progress) {
  return with_indirect(direct_over_texels(op, texel_receivers(package, view, progress), lamps, progress),
                       package, view, op, bounces, lamps);
}

void take_share(const Atlas& atlas, const Operator& op, std::span<const Rgb> share,
                std::vector<Image>& pages) {
  std::vector<Rgb> taken(share.begin(), share.end());
  for (Rgb& light : taken) light *= -1.0f;
  add_to_pages(atlas, op, taken, pages);
  for (Image& page : pages)
    for (float& v : page.data) v = std::max(v, 0.0f);
}

}  // namespace sconce
