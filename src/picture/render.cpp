// SPDX-License-Identifier: Apache-2.0
#include "picture/render.h"

#include <atomic>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/glint.h"
#include "picture/gloss.h"
#include "picture/highlight.h"
#include "picture/seen.h"

namespace sconce {

namespace {

constexpr int kTile = 32;  // pixels
constexpr uint32_t kLobeStream = 0x6c6f6265u, kGlintStream = 0x676c696eu, kPickStream = 0x7069636bu;
// Where a ray meets a lobe wider than a pixel, several rays follow it, and lamps in it are sought.
constexpr float kSharp = 0.05f;  // roughness
constexpr uint32_t kLobeRays = 4;
constexpr int kMostPanes = 64;  // in a row; those behind are opaque

}  // namespace

Rgb View::illuminance(const Hit& hit, const Mixed& mix) const {
  const LightmapSide& place = side(hit.triangle, hit.back);
  if (place.page < 0) return Rgb(0);
  const Vec2 b = hit.barycentric, uv = place.at(b);
  const auto page = static_cast<std::size_t>(place.page);
  Rgb e = bilinear(mix.pages[page], uv);
  if (mix.components.empty()) return e;
  const Vec3 offset = (hit.back ? -1.0f : 1.0f) * normal_offset(scene(), world(), hit.triangle, b);
  if (offset == Vec3(0)) return e;
  for (int axis = 0; axis < 3; ++axis)
    e += offset[axis] * bilinear(mix.components[3 * page + static_cast<std::size_t>(axis)], uv);
  return {std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f)};
}

Rgb View::glints(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Sight& sight) const {
  if (sight.glints) return sight.glints(surface, to_eye, at, sight.stream ^ kGlintStream, sight.index);
  Rgb sum;
  for (const std::size_t lamp : near_) {
    const Rgb weight = weight_of(sight.mix.spec, lamps_->all()[lamp].group);
    if (weight.is_black()) continue;
    const uint32_t stream = mix32(sight.stream ^ kGlintStream, static_cast<uint32_t>(lamp));
    sum += weight * glint(*lamps_, lamp, tracer_, surface, to_eye, at, sobol_pair(sight.index, 0, stream));
  }
  return sum;
}

Rgb View::reflected(const Ray& ray, const Hit& hit, const Shade& surface, const Rgb& through,
                    const Sight& sight, int met) const {
  const bool lit = !hit.back || scene()[world().materials[hit.triangle]].double_sided;
  SurfacePoint at = surface_point(world(), hit);
  const auto mapped = [&] {
    const Vec3 offset = normal_offset(scene(), world(), hit.triangle, hit.barycentric);
    return hit.back ? -offset : offset;
  };
  Rgb light = illuminance(hit, sight.mix);
  if (lit && sight.added && (met == 0 || !sight.mirrored)) {
    SurfacePoint seen = at;
    if (!sight.mix.components.empty()) seen.shading_normal += mapped();
    light += sight.added(seen);
  }
  // The last surface in a row is as if matt, the first one where none is followed.
  if (met == sight.reflections) return surface.base_color * light * kInvPi + through;
  const Rgb diffuse = surface.receiver_albedo() * light * kInvPi + through;
  if (!lit || !mirrors(surface)) return diffuse;

  at.shading_normal += mapped();
  const bool wide = surface.roughness > kSharp;
  std::optional<const Highlights> highlights;
  if (wide) highlights.emplace(*lamps_, sight.mix.spec, surface, -ray.direction, at);
  const uint32_t rays = met == 0 && wide ? kLobeRays : 1;
  const Rgb beside = met == 0 && sight.mirrored ? sight.mirrored(at) : Rgb();
  Rgb sum;
  for (uint32_t i = 0; i < rays; ++i) {
    Sight onwards = sight;
    onwards.index = sight.index * rays + i;
    onwards.highlights = highlights ? &*highlights : nullptr;
    const auto dimension = static_cast<uint32_t>(met);
    const Vec2 u = sobol_pair(onwards.index, dimension, sight.stream);
    const Gloss part = gloss(surface, -ray.direction, at, u);
    const Vec3 start = offset_origin(at.position, at.geometric_normal, part.direction);
    sum += part.diffuse * diffuse + part.mirrored * look({start, part.direction}, onwards, met + 1).radiance;
    if (highlights)
      sum += highlights->pick(tracer_, sobol_pair(onwards.index, dimension, sight.stream ^ kPickStream));
    sum += glints(surface, -ray.direction, at, onwards);
  }
  return sum / static_cast<float>(rays) + beside;
}

View::Seen View::look(const Ray& ray, const Sight& sight, int met, int panes) const {
  Seen seen;
  const Hit hit = tracer_.closest(ray);
  Shade surface;
  if (hit) {
    surface = shade(scene(), world(), hit.triangle, hit.barycentric);
    const Passing passing = panes < kMostPanes ? tracer_.passing(hit) : Passing();
    if (passing.share() > 0) {
      const Seen behind = look(tracer_.beyond(ray, hit), sight, met, panes + 1);
      seen.emitter = behind.emitter;
      seen.radiance = passing.clear * behind.radiance;
      if (passing.clear < 1) {
        Shade rest = surface;
        rest.base_color *= 1 - passing.transmitted;
        seen.radiance +=
            (1 - passing.clear) *
            reflected(ray, hit, rest, passing.transmitted * passing.base_color * behind.radiance, sight, met);
      }
    } else {
      seen.radiance = reflected(ray, hit, surface, Rgb(0.0f), sight, met);
    }
  }
  for_each_shine(scene(), world(), ray, hit, surface.emission, [&](Id<LightGroup> group, const Rgb& shine) {
    seen.emitter = seen.emitter || !shine.is_black();
    const float share = hit && sight.highlights != nullptr ? sight.highlights->share(ray, hit) : 1;
    seen.radiance += share * weight_of(sight.mix.spec, group) * shine;
  });
  return seen;
}

Image View::render(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
                   const PictureParams& params, const Progress& progress, Image* coverage,
                   const AddedLight& added, const std::vector<Image>& components, const AddedGlints& glints,
                   const AddedLight& mirrored) const {
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
    Rgb sum;
    int emitters = 0;
    const auto id = static_cast<uint32_t>(y) * static_cast<uint32_t>(params.width) + static_cast<uint32_t>(x);
    const uint32_t stream = mix32(id, params.seed ^ kLobeStream);
    for (int s = 0; s < params.samples; ++s) {
      const auto index = static_cast<uint32_t>(s);
      Sight sight{mixed, {}, {}, glints, params.reflections, stream, index};
      if (added) sight.added = [&](const SurfacePoint& at) { return added(at, x, y, index); };
      if (mirrored) sight.mirrored = [&](const SurfacePoint& at) { return mirrored(at, x, y, index); };
      const Seen seen = look({lens.eye(), lens.direction(ray_point(params, x, y, s))}, sight);
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
