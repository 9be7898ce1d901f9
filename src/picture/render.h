// SPDX-License-Identifier: Apache-2.0
// The CPU picture: camera rays, mixed lightmap x base colour, visible emitters following their faders.
#pragma once

#include "core/progress.h"
#include "mix/mix.h"
#include "trace/tracer.h"

namespace sconce {

struct PictureParams {
  int width = 1280, height = 720;
  int samples = 16;      ///< per pixel, box filter of one pixel
  uint32_t seed = 0;
};

/// A package ready to be looked at: geometry, rays, lightmap coordinates.
class View {
 public:
  explicit View(const Package& package);

  /// Linear picture, luminance in cd/m2 per channel, before exposure and tone curve: sum_g w_g (eps_g + rho/pi E_g).
  /// @param pages     mix_pages() of the same mix
  /// @param coverage  when given: per pixel, the share of samples that see an emitter
  Image render(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages, const PictureParams& params,
               const Progress& progress = {}, Image* coverage = nullptr) const;

  const Scene& scene() const { return scene_; }
  const World& world() const { return world_; }
  /// The named camera; the first one for an empty name; one at eye height (and a warning) where the scene has none.
  /// @throws UsageError naming the cameras
  Camera camera(std::string_view name, const Progress& progress = {}) const;

 private:
  const Package* package_;
  Scene scene_;
  World world_;
  Tracer tracer_;
  // lightmap coordinates per World triangle
};

}  // namespace sconce
