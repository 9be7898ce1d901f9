// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "picture/render.h"

namespace sconce {

/// The picture plane in front of a camera's eye. The vertical field of view is the camera's, the horizontal
/// follows from the picture's shape.
class Lens {
 public:
  /// @throws Error for a camera without direction or field of view
  Lens(const Camera& camera, const PictureParams& params);

  const Vec3& eye() const { return eye_; }
  /// @param p  in pixels from the top left
  Vec3 direction(Vec2 p) const { return glm::normalize(top_left_ + p.x * x_ + p.y * y_); }

 private:
  Vec3 eye_, x_, y_, top_left_;
};

}  // namespace sconce
