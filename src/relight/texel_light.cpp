// SPDX-License-Identifier: Apache-2.0
#include "relight/texel_light.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kShareStream = 0x73686172u, kMiddleStream = 0x6d696464u;
constexpr uint32_t kShareRays = 32;  // per texel and lamp

}  // namespace

std::vector<Rgb> direct_at_middles(const Operator& op, const MovedLamps& lamps) {
  std::vector<Rgb> light(op.receivers.size());
  parallel_for(light.size(), 1024, [&](std::size_t i) {
    light[i] =
        lamps.illuminance(point_of(op.receivers[i]), mix32(kMiddleStream, static_cast<uint32_t>(i)), 0);
  });
  return light;
}

std::vector<Rgb> lightmap_share(const Package& package, const View& view, const Operator& op,
                                const FoldedBounces& bounces, const MovedLamps& lamps,
                                const Progress& progress) {
  const RelightReceivers texels = texel_receivers(package, view, progress);
  std::vector<Rgb> share = Relighter(package, view, op, bounces, lamps).indirect();
  constexpr std::size_t kBlock = 1024;
  const std::size_t blocks = (share.size() + kBlock - 1) / kBlock;
  std::atomic<uint64_t> done = 0;
  parallel_for(blocks, 1, [&](std::size_t block) {
    progress.check();
    for (std::size_t i = kBlock * block; i < std::min(share.size(), kBlock * (block + 1)); ++i) {
      const auto at = std::lower_bound(texels.places.begin(), texels.places.end(), op.places[i]);
      if (at == texels.places.end() || *at != op.places[i]) continue;
      const Footprint texel = texels.source.footprint(static_cast<std::size_t>(at - texels.places.begin()));
      const uint32_t stream = mix32(kShareStream, op.places[i]);
      Rgb direct;
      for (uint32_t r = 0; r < kShareRays; ++r)
        direct += lamps.illuminance(texel.sample(sobol_pair(r, 0, stream)), ~stream, r);
      share[i] += direct * (1.0f / kShareRays);
    }
    progress.at("what leaves the lightmap", ++done, blocks);
  });
  return share;
}

void take_share(const Package& package, const View& view, const Operator& op, std::span<const Rgb> share,
                std::vector<Image>& pages) {
  std::vector<Rgb> taken(share.begin(), share.end());
  for (Rgb& light : taken) light *= -1.0f;
  add_to_pages(package, view, op, taken, pages);
  for (Image& page : pages)
    for (float& v : page.data) v = std::max(v, 0.0f);
}

}  // namespace sconce
