// SPDX-License-Identifier: Apache-2.0
// What surfaces a camera sees, whatever their light.
#include <algorithm>

#include "core/parallel.h"
#include "picture/render.h"
#include "picture/seen.h"

namespace sconce {

Image View::surfaces(const Camera& camera, const PictureParams& params, const Progress& progress) const {
  params.check();
  const Lens lens(camera, params);
  const Vec3 ahead = -normalize_or(Vec3(camera.frame[2]), Vec3(0, 0, 1));
  const float share = 1.0f / static_cast<float>(params.samples);
  Image out(params.width, params.height,
            {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "position.X",
             "position.Y", "position.Z", "depth.Z", "id.ID"});
  const auto pixel = [&](int x, int y) {
    float* to = out.at(x, y);
    for (int s = 0; s < params.samples; ++s) {
      const Hit hit = tracer_.closest({lens.eye(), lens.direction(ray_point(params, x, y, s))});
      if (!hit) continue;
      const Rgb albedo = shade(scene(), world(), hit.triangle, hit.barycentric).receiver_albedo();
      const float side = hit.back ? -share : share;
      Vec3 normal = world().normal(hit.triangle, hit.barycentric);
      if (sees_normal_maps()) normal += normal_offset(scene(), world(), hit.triangle, hit.barycentric);
      to[0] += share * albedo.r, to[1] += share * albedo.g, to[2] += share * albedo.b;
      for (int axis = 0; axis < 3; ++axis) to[3 + axis] += side * normal[axis];
    }
    const Ray ray{lens.eye(), lens.direction(Vec2(x, y) + Vec2(0.5f))};
    const Hit hit = tracer_.closest(ray);
    to[9] = kNothing;
    if (!hit) return;
    const Vec3 at = world().position(hit.triangle, hit.barycentric);
    for (int axis = 0; axis < 3; ++axis) to[6 + axis] = at[axis];
    to[9] = glm::dot(at - lens.eye(), ahead);
    to[10] = static_cast<float>(world().instances[hit.triangle].value + 1);
  };
  parallel_for(static_cast<std::size_t>(params.height), 4, [&](std::size_t y) {
    progress.check();
    for (int x = 0; x < params.width; ++x) pixel(x, static_cast<int>(y));
  });
  return out;
}

}  // namespace sconce
