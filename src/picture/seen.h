// SPDX-License-Identifier: Apache-2.0
// What pictures and cached hits agree on: where a pixel's rays go, where the lightmap is looked up,
// what shines by itself.
#pragma once

#include "core/error.h"
#include "core/sobol.h"
#include "light/sky.h"
#include "mix/mix.h"
#include "picture/hits.h"
#include "scene/lens.h"
#include "trace/tracer.h"

namespace sconce {

/// Where the s-th ray of a pixel goes, in pixels from the top left.
inline Vec2 ray_point(const PictureParams& params, int x, int y, int s) {
  if (params.samples == 1) return Vec2(x, y) + Vec2(0.5f);
  const auto id = static_cast<uint32_t>(y) * static_cast<uint32_t>(params.width) + static_cast<uint32_t>(x);
  return Vec2(x, y) + Sampler(params.seed, id, static_cast<uint32_t>(s)).next();
}

/// Between the centres of texels `low` and `low` + 1, clamped at the page's edges.
struct TexelPlace {
  int low = 0;
  float fraction = 0;

  TexelPlace(float t, int size) {
    const float at = t * static_cast<float>(size) - 0.5f;
    const float inside = at > 0 ? std::min(at, static_cast<float>(size - 1)) : 0.0f;
    low = static_cast<int>(inside);
    fraction = inside - static_cast<float>(low);
  }
};

/// Bilinear between texel centres, clamped at the page's edges.
inline Rgb bilinear(const Image& page, Vec2 uv) {
  const TexelPlace x(uv.x, page.width), y(uv.y, page.height);
  const int x1 = std::min(x.low + 1, page.width - 1), y1 = std::min(y.low + 1, page.height - 1);
  const Rgb top = (1 - x.fraction) * page.rgb_at(x.low, y.low) + x.fraction * page.rgb_at(x1, y.low);
  const Rgb bottom = (1 - x.fraction) * page.rgb_at(x.low, y1) + x.fraction * page.rgb_at(x1, y1);
  return (1 - y.fraction) * top + y.fraction * bottom;
}

/// Weight 1 where a light belongs to no group.
inline Rgb weight_of(const MixSpec& mix, Id<LightGroup> group) {
  return group.valid() ? mix.weights[group.value] : Rgb(1);
}

inline Rgb sky_radiance(const Light& light, const Vec3& direction) {
  SkyLamp lamp;
  lamp.scale = light.intensity;
  lamp.to_local = glm::transpose(Mat3(light.frame));
  const Image& image = std::get<SkyLight>(light.shape).image;
  if (!image.data.empty()) lamp.image = &image;
  return radiance(lamp, direction);
}

/// @throws Error when the mix or its pages are of another package than the hits
template <class Page>
void check_fits(const CameraHits& hits, const MixSpec& mix, const std::vector<Page>& pages) {
  bool fits = mix.weights.size() == hits.groups && pages.size() == static_cast<std::size_t>(hits.pages);
  for (const Page& page : pages)
    fits =
        fits && page.width == hits.page_width && page.height == hits.page_height &&
        page.data.size() == 3 * static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height);
  if (!fits) throw Error({}, "the mix does not belong to this package");
}

/// Calls shine(group, cd/m2 at weight 1) for what shines where a ray ends: the skies where it leaves the
/// scene, else the surface, whose emission is given.
template <class F>
void for_each_shine(const Scene& scene, const World& world, const Ray& ray, const Hit& hit,
                    const Rgb& emission, const F& shine) {
  if (hit) {
    if (!hit.back || scene[world.materials[hit.triangle]].double_sided)
      shine(scene[world.instances[hit.triangle]].group, emission);
    return;
  }
  for (const Light& light : scene.lights)
    if (std::holds_alternative<SkyLight>(light.shape)) shine(light.group, sky_radiance(light, ray.direction));
}

}  // namespace sconce
