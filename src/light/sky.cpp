// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include "light/punctual.h"

namespace sconce {

namespace {

// Pixels are constant patches of the sphere: bands of equal polar angle, so a pixel's solid angle is known
// exactly.
double band_top(const Image& image, int y) {
  return std::cos(static_cast<double>(kPi) * y / image.height);
}

double pixel_solid_angle(const Image& image, int y) {
  return 2.0 * static_cast<double>(kPi) / image.width * (band_top(image, y) - band_top(image, y + 1));
}

struct Pixel {
  int x, y;
};

Pixel pixel_of(const SkyLamp& lamp, const Vec3& direction) {
  const Vec3 d = lamp.to_local * direction;
  const float theta = std::acos(std::clamp(d.y, -1.0f, 1.0f));
  const float u = 0.5f + std::atan2(d.x, -d.z) / (2 * kPi);
  return {std::clamp(static_cast<int>(u * static_cast<float>(lamp.image->width)), 0, lamp.image->width - 1),
          std::clamp(static_cast<int>(theta * kInvPi * static_cast<float>(lamp.image->height)), 0,
                     lamp.image->height - 1)};
}

}  // namespace

Lamp make_sky(const Light& light, const SkyLight& sky) {
  SkyLamp lamp;
  lamp.scale = light.intensity;
  lamp.to_local = glm::transpose(Mat3(light.frame));
  Rgb mean{1.0f};
  if (!sky.image.data.empty()) {
    lamp.image = &sky.image;
    std::vector<double> weights;
    weights.reserve(sky.image.pixels());
    double sum[3] = {0, 0, 0};
    double total = 0;
    for (int y = 0; y < sky.image.height; ++y)
      for (int x = 0; x < sky.image.width; ++x) {
        const Rgb c = sky.image.rgb_at(x, y);
        const double omega = pixel_solid_angle(sky.image, y);
        weights.push_back(omega * static_cast<double>(std::max(0.0f, luminance(c))));
        total += weights.back();
        sum[0] += omega * static_cast<double>(c.r);
        sum[1] += omega * static_cast<double>(c.g);
        sum[2] += omega * static_cast<double>(c.b);
      }
    // A little everywhere, so that no colour with zero luminance weight is ever missed.
    for (int y = 0; y < sky.image.height; ++y)
      for (int x = 0; x < sky.image.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(sky.image.width) +
                              static_cast<std::size_t>(x);
        weights[i] += 0.02 * total * pixel_solid_angle(sky.image, y) / (4.0 * static_cast<double>(kPi));
      }
    lamp.pixels = AliasTable(weights);
    const double sphere = 4.0 * static_cast<double>(kPi);
    mean = Rgb(static_cast<float>(sum[0] / sphere), static_cast<float>(sum[1] / sphere),
               static_cast<float>(sum[2] / sphere));
  }
  const Rgb flux = light.intensity * mean * kPi;
  return {light.name, light.group, std::move(lamp), flux, true};
}

bool sample(const SkyLamp& lamp, Vec2 u, LightSample& out) {
  if (lamp.image == nullptr) {
    const float y = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - y * y)), phi = 2 * kPi * u.y;
    out = {Vec3(r * std::cos(phi), y, r * std::sin(phi)), kInfinite, lamp.scale, 1 / (4 * kPi), false};
    return true;
  }
  const std::size_t i = lamp.pixels.sample(u.x);
  const int width = lamp.image->width;
  const int x = static_cast<int>(i % static_cast<std::size_t>(width)),
            y = static_cast<int>(i / static_cast<std::size_t>(width));
  const float top = static_cast<float>(band_top(*lamp.image, y)),
              bottom = static_cast<float>(band_top(*lamp.image, y + 1));
  const float height = top + (bottom - top) * u.y, r = std::sqrt(std::max(0.0f, 1 - height * height));
  const float phi = ((static_cast<float>(x) + u.x) / static_cast<float>(width) - 0.5f) * 2 * kPi;
  const Vec3 local(r * std::sin(phi), height, -r * std::cos(phi));
  const float density = static_cast<float>(lamp.pixels.probability(i) / pixel_solid_angle(*lamp.image, y));
  out = {glm::transpose(lamp.to_local) * local, kInfinite, lamp.scale * lamp.image->rgb_at(x, y), density,
         false};
  return true;
}

EmittedLight emit(const SkyLamp& lamp, const Vec3& center, float radius, Vec2 where, Vec2 whither) {
  LightSample from;
  sample(lamp, whither, from);
  return {on_disk(center, radius, from.direction, where), Vec3(0), -from.direction,
          from.radiance * (kPi * radius * radius / from.pdf)};
}

Rgb radiance(const SkyLamp& lamp, const Vec3& direction) {
  if (lamp.image == nullptr) return lamp.scale;
  const Pixel p = pixel_of(lamp, direction);
  return lamp.scale * lamp.image->rgb_at(p.x, p.y);
}

float pdf(const SkyLamp& lamp, const Vec3& direction) {
  if (lamp.image == nullptr) return 1 / (4 * kPi);
  const Pixel p = pixel_of(lamp, direction);
  const std::size_t i = static_cast<std::size_t>(p.y) * static_cast<std::size_t>(lamp.image->width) +
                        static_cast<std::size_t>(p.x);
  return static_cast<float>(lamp.pixels.probability(i) / pixel_solid_angle(*lamp.image, p.y));
}

}  // namespace sconce
