// SPDX-License-Identifier: Apache-2.0
// The CPU picture: camera rays, mixed lightmap x base colour, visible emitters following their faders.
#pragma once

#include <array>
#include <functional>

#include "core/progress.h"
#include "mix/mix.h"
#include "trace/tracer.h"

namespace sconce {

/// Light beside the lightmap's: illuminance at a point that sample number `sample` of pixel (x, y) sees, lux.
/// Thread-safe.
using AddedLight = std::function<Rgb(const SurfacePoint& at, int x, int y, uint32_t sample)>;

struct PictureParams {
  int width = 1280, height = 720;
  int samples = 16;  ///< per pixel, box filter of one pixel
  uint32_t seed = 0;
};

/// A camera at `eye` that looks at `target`, y up, with Camera's default field of view.
/// @throws UsageError when the two are one point
Camera look_at(const Vec3& eye, const Vec3& target);

/// A package ready to be looked at: geometry, rays, lightmap coordinates. Thread-safe once built.
class View {
 public:
  /// Where one side of a triangle lies in the lightmap.
  struct Side {
    int page = -1;
    std::array<Vec2, 3> uv{};  ///< [0,1], in the order of the World triangle's vertices
  };

  /// Reads the scene and builds its rays. The package must outlive it. @throws Error naming the damaged file
  explicit View(const Package& package);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// Linear picture, luminance in cd/m2 per channel, before exposure and tone curve: sum_g w_g (eps_g +
  /// rho/pi E_g). Backs are black, but for those with a lightmap of their own (twins) and for what
  /// double-sided materials emit. Rays that leave the scene see its skies. The same bits with any number of
  /// threads.
  /// @param pages     mix_pages() of the same mix
  /// @param coverage  when given: per pixel, the share of samples that see an emitter (or the sky), one
  /// channel
  /// @param added     light beside the lightmap's; may be empty
  /// @throws UsageError for a size or sample count below 1, Error for a camera without direction; Cancelled
  Image render(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
               const PictureParams& params, const Progress& progress = {}, Image* coverage = nullptr,
               const AddedLight& added = {}) const;

  /// Without twins: their lightmap coordinates are kept beside the triangles they share.
  const Scene& scene() const { return scene_; }
  const World& world() const { return world_; }
  const Tracer& tracer() const { return tracer_; }
  /// The named camera; the first one for an empty name; one at eye height (and a warning) where the scene has
  /// none.
  /// @throws UsageError naming the cameras
  Camera camera(std::string_view name, const Progress& progress = {}) const;
  const Side& side(uint32_t triangle, bool back) const { return (back ? back_ : front_)[triangle]; }

 private:
  struct Seen {
    Rgb radiance;  ///< cd/m2
    bool emitter = false;
  };

  /// Of an instance that is shown: its page, and the mesh that holds its back's lightmap coordinates.
  struct Placement {
    int page = -1, twin_page = -1;
    Id<Mesh> twin;
  };

  static Scene load(const Package& package, std::vector<Placement>* placements);
  Side front_side(std::size_t triangle) const;
  Side back_side(std::size_t triangle) const;
  Rgb illuminance(const Side& side, Vec2 barycentric, const std::vector<Image>& pages) const;
  Seen look(const Ray& ray, const MixSpec& mix, const std::vector<Image>& pages,
            const std::function<Rgb(const SurfacePoint&)>& added) const;
  Camera eye_height_camera() const;

  const Package* package_;
  std::vector<Placement> placements_;  ///< per instance of scene_; filled while scene_ is loaded
  Scene scene_;
  World world_;
  Tracer tracer_;
  std::vector<Side> front_, back_;  ///< per World triangle
};

}  // namespace sconce
