// SPDX-License-Identifier: Apache-2.0
// The CPU picture: camera rays, mixed lightmap x base colour, visible emitters following their faders, and
// what mirrors, metals and glossy surfaces show of them.
#pragma once

#include <functional>
#include <memory>

#include "core/progress.h"
#include "light/lamp.h"
#include "mix/mix.h"
#include "package/shown_scene.h"
#include "picture/hits.h"
#include "scene/lens.h"
#include "scene/objects.h"
#include "trace/tracer.h"

namespace sconce {

class Highlights;

/// Light beside the lightmap's: illuminance at a point that sample number `sample` of pixel (x, y) sees, lux;
/// its shading normal is the normal map's where components are given. Thread-safe.
using AddedLight = std::function<Rgb(const SurfacePoint& at, int x, int y, uint32_t sample)>;

/// In place of the mix's lamps: what a glossy surface mirrors of light fields, cd/m2. Thread-safe.
using AddedGlints = std::function<Rgb(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at,
                                      uint32_t stream, uint32_t index)>;

/// A package ready to be looked at: geometry, rays, lightmap coordinates. Thread-safe once built.
class View {
 public:
  /// Reads the scene and builds its rays. The package must outlive it. @throws Error naming the damaged file
  explicit View(const Package& package);
  /// One more, whose objects may be moved. The package must outlive it.
  View(const Package& package, ShownScene shown);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// Puts objects elsewhere; the lightmap's places move along, and skies and parallel lights stay. Nobody may
  /// look meanwhile.
  void place(const ObjectPlaces& places, const ObjectMoves& moves);

  /// Linear picture, luminance in cd/m2 per channel, before exposure and tone curve: sum_g w_g (eps_g +
  /// rho/pi E_g). Backs are black, but for those with a lightmap of their own (twins) and for what
  /// double-sided materials emit. What panes let through is seen behind them. Rays that leave the scene see
  /// its skies. With params.reflections surfaces also show what they mirror (picture/gloss.h), lit by the
  /// same mix, and glints of its light fields; the last in a row shows all that it reflects without
  /// direction, rho/pi E. The same bits with any number of threads.
  /// @param pages       mix_pages() of the same mix
  /// @param coverage    when given: per pixel, the share of samples that see an emitter (or the sky)
  /// directly, one channel
  /// @param added       light beside the lightmap's; may be empty
  /// @param mirrored    what the surface that a pixel sees mirrors of light beside the lightmap's, cd/m2, in
  /// place of following it: light at a mirror's other end is the lightmap's then; may be empty
  /// @param components  mix_components() of the same mix: with them normal maps are seen, E = max(0, E + g .
  /// (n - n_s)); without them surfaces are as smooth as their geometry
  /// @throws UsageError for a size or sample count below 1, Error for a camera without direction; Cancelled
  Image render(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
               const PictureParams& params, const Progress& progress = {}, Image* coverage = nullptr,
               const AddedLight& added = {}, const std::vector<Image>& components = {},
               const AddedGlints& glints = {}, const AddedLight& mirrored = {}) const;
  /// Whether components would be seen.
  bool sees_normal_maps() const;
  /// What the s-th ray of every pixel meets, whatever the mix: for pictures while faders move. Normal maps
  /// are not seen.
  /// @throws as render()
  CameraHits hits(const Camera& camera, const PictureParams& params, int s = 0,
                  const Progress& progress = {}) const;

  /// What surfaces are seen: albedo.R, G, B and normal.X, Y, Z (in the world, towards the eye), means over
  /// a pixel's samples; at its centre position.X, Y, Z (in the world, m), depth.Z (m, along the camera's
  /// axis; kNothing where nothing is) and id.ID (1 + number of the instance; 0 where nothing is). Panes are
  /// surfaces.
  /// @throws as render()
  Image surfaces(const Camera& camera, const PictureParams& params, const Progress& progress = {}) const;
  static constexpr float kNothing = 1e10f;

  const ShownScene& shown() const { return shown_; }
  const Scene& scene() const { return shown_.scene; }  ///< without twins, see ShownScene
  const World& world() const { return shown_.world; }
  const Tracer& tracer() const { return tracer_; }
  TracedScene traced() const { return {scene(), world(), tracer_}; }
  /// Where that side of a World triangle lies in the lightmap.
  const LightmapSide& side(std::size_t triangle, bool back) const {
    return (back ? shown_.back : shown_.front)[triangle];
  }
  /// The named camera; the first one for an empty name; one at eye height (and a warning) where the scene has
  /// none.
  /// @throws UsageError naming the cameras
  Camera camera(std::string_view name, const Progress& progress = {}) const;

 private:
  struct Seen {
    Rgb radiance;  ///< cd/m2
    bool emitter = false;
  };
  /// A mix's images, per page.
  struct Mixed {
    const MixSpec& spec;
    const std::vector<Image>&pages, &components;
  };
  /// What a camera ray is followed with.
  struct Sight {
    const Mixed& mix;
    std::function<Rgb(const SurfacePoint&)> added, mirrored;
    const AddedGlints& glints;
    int reflections;
    uint32_t stream, index;                  ///< random numbers of the mirrors' lobes
    const Highlights* highlights = nullptr;  ///< of the surface whose lobe the ray is of
  };
  /// @param met    mirrors behind this ray
  /// @param panes  on the way since the last of them
  Seen look(const Ray& ray, const Sight& sight, int met = 0, int panes = 0) const;
  /// @param through  what the surface transmits
  Rgb reflected(const Ray& ray, const Hit& hit, const Shade& surface, const Rgb& through, const Sight& sight,
                int met) const;
  Rgb illuminance(const Hit& hit, const Mixed& mix) const;
  /// Of the mix's light fields, cd/m2.
  Rgb glints(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Sight& sight) const;
  Camera eye_height_camera() const;
  void find_lamps();

  const Package* package_;
  ShownScene shown_;
  Tracer tracer_;
  std::unique_ptr<const Lamps> lamps_;  ///< null where nothing mirrors
  std::vector<std::size_t> near_;       ///< those that are light fields
};

}  // namespace sconce
