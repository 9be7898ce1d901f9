// SPDX-License-Identifier: Apache-2.0
// The picture of picture/render.h, drawn by OpenGL.
#pragma once

#include <memory>
#include <optional>

#include "core/progress.h"
#include "gpu/framebuffer.h"
#include "gpu/geometry.h"
#include "gpu/light_source.h"
#include "mix/settings.h"
#include "scene/lens.h"
#include "tone/exposure.h"

namespace sconce::gpu {

/// A package ready to be drawn.
class View {
 public:
  /// @param context, shown  must outlive it
  /// @param normal_maps     are seen, by light sources that know directions; cost memory
  View(const Context& context, const ShownScene& shown, bool normal_maps = false);
  ~View();

  /// Draws; then linear(), coverage() and toned() tell what is seen. Equal to View::render of the CPU but for
  /// the texture filter's precision and the silhouettes' pixels; with several samples all pixels share their
  /// places.
  /// @param weights  of the light groups
  /// @throws UsageError for a size or sample count below 1, Error for a camera without direction or a picture
  /// too large; Cancelled
  void draw(const Camera& camera, const std::vector<Rgb>& weights, const LightSource& light,
            const PictureParams& params, const Progress& progress = {});

  Image linear() const;    ///< cd/m2, before exposure
  Image coverage() const;  ///< share of each pixel that shows an emitter or the sky, one channel
  /// Exposure, curve and sRGB transfer, applied on the device.
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const;

 private:
  struct Targets;
  void draw_sky(const Lens& lens, const std::vector<Rgb>& weights, Vec2 shift) const;
  std::vector<float> sums() const;

  const Context* context_;
  const ShownScene* shown_;
  Geometry geometry_;
  Program sky_, add_;
  std::vector<std::optional<Texture>> skies_;  ///< per light of the scene that is a sky
  std::unique_ptr<Targets> targets_;
  GLuint nothing_ = 0;  ///< vertex array of shaders that need no vertices
  int samples_ = 0;
};

}  // namespace sconce::gpu
