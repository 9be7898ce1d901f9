// SPDX-License-Identifier: Apache-2.0
#include "gpu/way.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/error.h"

namespace sconce::gpu {

namespace {

template <class F>
double seconds(F work) {
  using Clock = std::chrono::steady_clock;
  glFinish();
  const auto start = Clock::now();
  work();
  glFinish();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

MixCosts measure_mix(View& view, const AtlasMix& atlas, const PixelMix& pixel, const Camera& camera,
                     const std::vector<Rgb>& weights, PictureParams params, int rounds) {
  params.samples = 1;
  const double infinite = std::numeric_limits<double>::infinity();
  MixCosts costs{infinite, infinite, infinite};
  for (int round = 0; round < rounds; ++round) {
    costs.mix = std::min(costs.mix, seconds([&] { atlas.mix(weights); }));
    costs.atlas_frame =
        std::min(costs.atlas_frame, seconds([&] { view.draw(camera, weights, atlas, params); }));
    costs.pixel_frame =
        std::min(costs.pixel_frame, seconds([&] { view.draw(camera, weights, pixel, params); }));
  }
  return costs;
}

std::unique_ptr<LightSource> choose_mix(const Context& context, View& view, const EncodedLayers& layers,
                                        const ShaderTier& tier, const Camera& camera,
                                        const std::vector<Rgb>& weights, const PictureParams& params) {
  constexpr int kManySamples = 8;  // measuring costs two
  std::unique_ptr<PixelMix> pixel;
  std::unique_ptr<AtlasMix> atlas;
  if (tier.f16) atlas = std::make_unique<AtlasMix>(context, layers, tier);
  if (atlas == nullptr || (params.samples >= kManySamples && PixelMix::possible(context, layers, tier))) {
    pixel = std::make_unique<PixelMix>(context, layers, tier);
    pixel->set(weights);
  }
  if (atlas != nullptr) {
    atlas->mix(weights);
    if (pixel == nullptr) return atlas;
    if (measure_mix(view, *atlas, *pixel, camera, weights, params).atlas_pays(params.samples)) return atlas;
  }
  return pixel;
}

}  // namespace sconce::gpu
