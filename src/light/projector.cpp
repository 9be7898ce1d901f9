// SPDX-License-Identifier: Apache-2.0
#include "light/projector.h"

namespace sconce {

namespace {

/// Of the slide, in pixels from its upper left corner; bilinear, held at the edges.
Rgb slide_at(const Image& slide, Vec2 at) {
  const Vec2 p = glm::clamp(at - 0.5f, Vec2(0), Vec2(slide.width - 1, slide.height - 1));
  const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
  const int right = std::min(x + 1, slide.width - 1), below = std::min(y + 1, slide.height - 1);
  const Vec2 t = p - Vec2(x, y);
  return (slide.rgb_at(x, y) * (1 - t.x) + slide.rgb_at(right, y) * t.x) * (1 - t.y) +
         (slide.rgb_at(x, below) * (1 - t.x) + slide.rgb_at(right, below) * t.x) * t.y;
}

}  // namespace

Lamp make_projector(const Light& light, const ProjectorLight& projector) {
  ProjectorLamp lamp;
  lamp.slide = projector.slide;
  lamp.position = Vec3(light.frame[3]);
  for (int i = 0; i < 3; ++i) lamp.to_world[i] = glm::normalize(Vec3(light.frame[i]));
  const float half = std::tan(0.5f * projector.yfov);
  lamp.half = {half * projector.aspect, half};
  lamp.intensity = light.intensity;
  const Image& slide = *projector.slide;
  std::vector<double> weights(slide.pixels());
  double sum[3] = {0, 0, 0};
  for (int y = 0, i = 0; y < slide.height; ++y)
    for (int x = 0; x < slide.width; ++x, ++i) {
      const Rgb c = slide.rgb_at(x, y);
      // Each at least a little: bilinear light of a bright neighbour reaches into dark pixels.
      weights[static_cast<std::size_t>(i)] = static_cast<double>(luminance(c));
      sum[0] += static_cast<double>(c.r), sum[1] += static_cast<double>(c.g),
          sum[2] += static_cast<double>(c.b);
    }
  double mean = 0;
  for (const double w : weights) mean += w / static_cast<double>(weights.size());
  for (double& w : weights) w += 0.1 * mean;
  lamp.pixels = AliasTable(weights);
  // On a screen at distance 1, E = I0 x slide and dPhi = E dA.
  const double area = 4.0 * static_cast<double>(lamp.half.x) * static_cast<double>(lamp.half.y);
  const auto share = [&](double s) {
    return static_cast<float>(area * s / static_cast<double>(slide.pixels()));
  };
  return {light.name, light.group, lamp, light.intensity * Rgb(share(sum[0]), share(sum[1]), share(sum[2])),
          false};
}

bool sample(const ProjectorLamp& lamp, const Vec3& x, LightSample& out) {
  const Vec3 to = lamp.position - x, p = -to * lamp.to_world;  // right, up, backwards
  const float depth = -p.z;
  if (!(depth > 1e-6f)) return false;
  const Vec2 at = Vec2(p) / (depth * lamp.half);
  if (std::abs(at.x) > 1 || std::abs(at.y) > 1) return false;
  const Vec2 size(lamp.slide->width, lamp.slide->height);
  const Rgb color = slide_at(*lamp.slide, size * Vec2(0.5f + 0.5f * at.x, 0.5f - 0.5f * at.y));
  if (color.is_black()) return false;
  const float d = glm::length(to);
  out = {to / d, d, lamp.intensity * color * (d / (depth * depth * depth)), 1.0f, true};
  return true;
}

EmittedLight emit(const ProjectorLamp& lamp, Vec2 u) {
  const Image& slide = *lamp.slide;
  const std::size_t i = lamp.pixels.sample(u.x);
  const auto width = static_cast<std::size_t>(slide.width);
  const Vec2 at = Vec2(static_cast<float>(i % width), static_cast<float>(i / width)) + u;
  const Vec2 on = 2.0f * at / Vec2(slide.width, slide.height) - 1.0f;
  const float pixel = 4 * lamp.half.x * lamp.half.y / static_cast<float>(slide.pixels());
  return {lamp.position, Vec3(0),
          glm::normalize(lamp.to_world * Vec3(on.x * lamp.half.x, -on.y * lamp.half.y, -1)),
          lamp.intensity * slide_at(slide, at) * (pixel / static_cast<float>(lamp.pixels.probability(i)))};
}

}  // namespace sconce
