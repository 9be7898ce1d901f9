// SPDX-License-Identifier: Apache-2.0
#include "picture/render.h"

#include <atomic>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "light/sky.h"

namespace sconce {

namespace {

constexpr int kTile = 32;  // pixels

/// Bilinear between texel centres, clamped at the page's edges.
Rgb bilinear(const Image& page, Vec2 uv) {
  const auto place = [](float t, int size, int* low, int* high) {
    const float at = t * static_cast<float>(size) - 0.5f;
    const float inside = at > 0 ? std::min(at, static_cast<float>(size - 1)) : 0.0f;
    *low = static_cast<int>(inside);
    *high = std::min(*low + 1, size - 1);
    return inside - static_cast<float>(*low);
  };
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  const float wx = place(uv.x, page.width, &x0, &x1), wy = place(uv.y, page.height, &y0, &y1);
  const Rgb top = (1 - wx) * page.rgb_at(x0, y0) + wx * page.rgb_at(x1, y0);
  const Rgb bottom = (1 - wx) * page.rgb_at(x0, y1) + wx * page.rgb_at(x1, y1);
  return (1 - wy) * top + wy * bottom;
}

Rgb sky_radiance(const Light& light, const Vec3& direction) {
  SkyLamp lamp;
  lamp.scale = light.intensity;
  lamp.to_local = glm::transpose(Mat3(light.frame));
  const Image& image = std::get<SkyLight>(light.shape).image;
  if (!image.data.empty()) lamp.image = &image;
  return radiance(lamp, direction);
}

Rgb weight_of(const MixSpec& mix, Id<LightGroup> group) {
  return group.valid() ? mix.weights[group.value] : Rgb(1);
}

}  // namespace

Rgb View::illuminance(const Hit& hit, const Mixed& mix) const {
  const LightmapSide& place = side(hit.triangle, hit.back);
  if (place.page < 0) return Rgb(0);
  const Vec2 b = hit.barycentric;
  const Vec2 uv = (1 - b.x - b.y) * place.uv[0] + b.x * place.uv[1] + b.y * place.uv[2];
  const auto page = static_cast<std::size_t>(place.page);
  Rgb e = bilinear(mix.pages[page], uv);
  if (mix.components.empty()) return e;
  const Vec3 offset = (hit.back ? -1.0f : 1.0f) * normal_offset(scene(), world(), hit.triangle, b);
  if (offset == Vec3(0)) return e;
  for (int axis = 0; axis < 3; ++axis)
    e += offset[axis] * bilinear(mix.components[3 * page + static_cast<std::size_t>(axis)], uv);
  return {std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f)};
}

View::Seen View::look(const Ray& ray, const Mixed& mix,
                      const std::function<Rgb(const SurfacePoint&)>& added) const {
  Seen seen;
  const Hit hit = tracer_.closest(ray);
  if (!hit) {
    for (const Light& light : scene().lights) {
      if (!std::holds_alternative<SkyLight>(light.shape)) continue;
      const Rgb sky = sky_radiance(light, ray.direction);
      seen.emitter = seen.emitter || !sky.is_black();
      seen.radiance += weight_of(mix.spec, light.group) * sky;
    }
    return seen;
  }
  const Shade surface = shade(scene(), world(), hit.triangle, hit.barycentric);
  Rgb light = illuminance(hit, mix);
  const bool lit = !hit.back || scene()[world().materials[hit.triangle]].double_sided;
  if (lit && added) light += added(surface_point(world(), hit));
  seen.radiance = surface.receiver_albedo() * light * kInvPi;
  if (lit) {
    seen.emitter = !surface.emission.is_black();
    seen.radiance += weight_of(mix.spec, scene()[world().instances[hit.triangle]].group) * surface.emission;
  }
  return seen;
}

Image View::render(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
                   const PictureParams& params, const Progress& progress, Image* coverage,
                   const AddedLight& added, const std::vector<Image>& components) const {
  params.check();
  check_pages(package_->manifest(), mix, pages);
  if (!components.empty() && components.size() != 3 * pages.size())
    throw Error({}, "the mix does not belong to this package");
  const Mixed mixed{mix, pages, components};
  const Lens lens(camera, params);
  Image picture = Image::rgb(params.width, params.height);
  if (coverage != nullptr) *coverage = Image(params.width, params.height, {"coverage"});

  const int across = (params.width + kTile - 1) / kTile, down = (params.height + kTile - 1) / kTile;
  const auto tiles = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  const float share = 1.0f / static_cast<float>(params.samples);
  const auto pixel = [&](int x, int y) {
    const auto id = static_cast<uint32_t>(y) * static_cast<uint32_t>(params.width) + static_cast<uint32_t>(x);
    Rgb sum;
    int emitters = 0;
    for (int s = 0; s < params.samples; ++s) {
      const auto sample = static_cast<uint32_t>(s);
      const Vec2 inside = params.samples == 1 ? Vec2(0.5f) : Sampler(params.seed, id, sample).next();
      std::function<Rgb(const SurfacePoint&)> here;
      if (added) here = [&](const SurfacePoint& at) { return added(at, x, y, sample); };
      const Seen seen = look({lens.eye(), lens.direction(Vec2(x, y) + inside)}, mixed, here);
      sum += seen.radiance;
      emitters += seen.emitter ? 1 : 0;
    }
    picture.set_rgb(x, y, sum * share);
    if (coverage != nullptr) *coverage->at(x, y) = static_cast<float>(emitters) * share;
  };
  std::atomic<std::size_t> done = 0;
  progress.at("render", 0, tiles);
  parallel_for(tiles, 1, [&](std::size_t tile) {
    progress.check();
    const int x0 = static_cast<int>(tile % static_cast<std::size_t>(across)) * kTile;
    const int y0 = static_cast<int>(tile / static_cast<std::size_t>(across)) * kTile;
    for (int y = y0; y < std::min(y0 + kTile, params.height); ++y)
      for (int x = x0; x < std::min(x0 + kTile, params.width); ++x) pixel(x, y);
    progress.at("render", ++done, tiles);
  });
  return picture;
}

}  // namespace sconce
