// SPDX-License-Identifier: Apache-2.0
#include "session/reference.h"

#include "picture/seen.h"

namespace sconce {

ReferencePicture::ReferencePicture(const View& view, const Camera& camera, const PictureParams& params)
    : view_(&view), camera_(camera), width_(params.width), height_(params.height) {
  const Lens lens(camera, params);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
      const Ray ray{lens.eye(), lens.direction(Vec2(x, y) + Vec2(0.5f))};
      const Hit hit = view.tracer().closest(ray);
      Rgb emission;
      if (hit) {
        const Shade surface = shade(view.scene(), view.world(), hit.triangle, hit.barycentric);
        emission = surface.emission;
        // As in the lightmap's picture: a back has light where its material has two sides.
        if (!hit.back || view.side(hit.triangle, true).page >= 0) {
          points_.push_back(surface_point(view.world(), hit));
          pixels_.push_back(pixel);
          albedos_.push_back(surface.base_color);  // metals as if matt
        }
      }
      for_each_shine(view.scene(), view.world(), ray, hit, emission, [&](Id<LightGroup> group, const Rgb& c) {
        if (!c.is_black()) shines_.push_back({pixel, group, c});
      });
    }
}

PointMeter ReferencePicture::meter(std::shared_ptr<const StandingScene> standing) const {
  return standing ? PointMeter(std::move(standing), points_, ReceiverKind::pixel)
                  : PointMeter(*view_, points_, ReceiverKind::pixel);
}

Image ReferencePicture::picture(const MeasuredLight& light, const MixSpec& mix) const {
  Image out = Image::rgb(width_, height_);
  const auto add = [&](std::size_t pixel, const Rgb& c) {
    float* to = &out.data[3 * pixel];
    to[0] += c.r, to[1] += c.g, to[2] += c.b;
  };
  for (std::size_t i = 0; i < points_.size(); ++i)
    add(pixels_[i], albedos_[i] * light.mixed(i, mix) * kInvPi);
  for (const Shine& shine : shines_) add(shine.pixel, weight_of(mix, shine.group) * shine.radiance);
  return out;
}

}  // namespace sconce
