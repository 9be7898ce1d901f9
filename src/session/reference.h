// SPDX-License-Identifier: Apache-2.0
// A path-traced picture of the same scene, to hold the lightmap's against: every group apart, so that it
// follows the faders without a new ray.
#pragma once

#include "session/measure.h"

namespace sconce {

/// What the rays through pixel centres meet, and how much light the path tracer has found there so far.
class ReferencePicture {
 public:
  ReferencePicture(const View& view, const Camera& camera, const PictureParams& params);

  /// Makes a meter for what is seen; its light() is what picture() takes.
  /// @param standing  all as it stands, if not as the view has it: lamps shine from where they went, their
  /// bodies are seen where they were, as in the lightmap's picture
  PointMeter meter(std::shared_ptr<const StandingScene> standing = nullptr) const;
  std::span<const SurfacePoint> points() const { return points_; }
  /// Linear, cd/m2. @param light  of meter(), any pass
  Image picture(const MeasuredLight& light, const MixSpec& mix) const;
  const Camera& camera() const { return camera_; }

 private:
  struct Shine {
    std::size_t pixel;
    Id<LightGroup> group;
    Rgb radiance;
  };
  const View* view_;
  Camera camera_;
  int width_, height_;
  std::vector<SurfacePoint> points_;
  std::vector<std::size_t> pixels_;  ///< per point
  std::vector<Rgb> albedos_;         ///< per point
  std::vector<Shine> shines_;
};

}  // namespace sconce
