// SPDX-License-Identifier: Apache-2.0
// The picture of picture/render.h, drawn by OpenGL.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/progress.h"
#include "gpu/framebuffer.h"
#include "gpu/geometry.h"
#include "gpu/light_source.h"
#include "gpu/seen_surfaces.h"
#include "mix/settings.h"
#include "scene/lens.h"
#include "tone/exposure.h"

namespace sconce::gpu {

/// What is seen of a surface: light in cd/m2, what arrives there in lux, the share that it reflects, the
/// normal of its surface as (n + 1) / 2, or squares of four texels of its lightmap. The latter four have no
/// sky.
enum class Look : uint8_t { picture, illuminance, albedo, normals, charts };

struct DrawOptions {
  Look look = Look::picture;
  Vec2 page_size{1024};      ///< texels; for charts
  int first = 0, last = -1;  ///< samples to draw now, on top of those before `first`; -1: to the end
  std::span<AddedLight* const> added = {};  ///< to a picture
  bool keep = false;                        ///< the picture without added light, for relight(); of one sample
};

/// A package ready to be drawn.
class View {
 public:
  /// @param context, shown  must outlive it
  /// @param normal_maps     are seen, by light sources that know directions and by added light; cost memory
  View(const Context& context, const ShownScene& shown, bool normal_maps = false);
  ~View();

  /// Draws; then linear(), coverage() and toned() tell what is seen. Equal to View::render of the CPU but for
  /// the texture filter's precision and the silhouettes' pixels; with several samples all pixels share their
  /// places.
  /// @param weights  of the light groups
  /// @throws UsageError for a size or sample count below 1, Error for a camera without direction or a picture
  /// too large; Cancelled
  void draw(const Camera& camera, const std::vector<Rgb>& weights, const LightSource& light,
            const PictureParams& params, const Progress& progress = {}, const DrawOptions& options = {});

  /// The picture of the last draw(), which kept it, again with light that was added to it before changed: for
  /// lamps that move while camera, size and mix stay. Nothing of the scene is drawn. @throws UsageError
  void relight(std::span<AddedLight* const> added);

  const Geometry& geometry() const { return geometry_; }
  /// The same triangles at other places. @param shown  must outlive it from now on
  void follow(const ShownScene& shown) { shown_ = &shown, geometry_.follow(shown); }

  Image linear() const;    ///< cd/m2, before exposure
  Image coverage() const;  ///< share of each pixel that shows an emitter or the sky, one channel
  /// Exposure, curve and sRGB transfer, applied on the device.
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const;
  /// The sum of the samples() drawn: RGB, and the coverage.
  const Texture& sum() const;
  int samples() const { return samples_; }

 private:
  struct Targets;
  struct Surfaces;
  const Program& surface_for(const LightSource& light);
  void draw_sky(const Lens& lens, const std::vector<Rgb>& weights, Vec2 shift) const;
  void add(std::span<AddedLight* const> added, const Lens& lens, Vec2 shift) const;
  void add_pass() const;
  std::vector<float> sums() const;

  const Context* context_;
  const ShownScene* shown_;
  Geometry geometry_;
  Program sky_, add_;
  std::unique_ptr<Program> surface_;  ///< kept for the light source that it was made for
  std::string surface_text_;
  std::vector<std::optional<Texture>> skies_;  ///< per light of the scene that is a sky
  std::unique_ptr<Targets> targets_;
  std::unique_ptr<Surfaces> surfaces_;  ///< where light was added
  GLuint nothing_ = 0;                  ///< vertex array of shaders that need no vertices
  int samples_ = 0;
  bool summed_ = false;  ///< else the one pass is the sum
};

}  // namespace sconce::gpu
