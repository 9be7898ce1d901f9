// SPDX-License-Identifier: Apache-2.0
// How a picture looks through a camera: the one rule that rays and rasterisation share.
#pragma once

#include "scene/scene.h"

namespace sconce {

struct PictureParams {
  int width = 1280, height = 720;
  int samples = 16;  ///< per pixel, box filter of one pixel; 1 = at the pixel's centre
  uint32_t seed = 0;
  /// Mirrors, metals and glossy surfaces that a camera ray is followed over, one behind the other. 0 = none
  /// shows what it mirrors: what rasterisation and cached hits draw in any case.
  int reflections = 0;

  /// @throws UsageError for a size or sample count below 1
  void check() const;
};

/// The picture plane in front of a camera's eye. The vertical field of view is the camera's, the horizontal
/// follows from the picture's shape.
class Lens {
 public:
  /// @throws Error for a camera without direction or field of view
  Lens(const Camera& camera, const PictureParams& params);

  const Vec3& eye() const { return eye_; }
  /// @param p  in pixels from the top left
  Vec3 direction(Vec2 p) const { return glm::normalize(plane_ * Vec3(p, 1)); }
  /// (x, y, 1) in pixels from the top left -> direction in the world, not normalised, depth 1.
  const Mat3& plane() const { return plane_; }

 private:
  Vec3 eye_;
  Mat3 plane_;
};

/// A camera at `eye` that looks at `target`, y up, with Camera's default field of view.
/// @throws UsageError when the two are one point
Camera look_at(const Vec3& eye, const Vec3& target);

/// The named camera, or the first one for an empty name; null where the scene has none and none is named.
/// @throws UsageError naming the cameras
const Camera* find_camera(const Scene& scene, std::string_view name);

}  // namespace sconce
