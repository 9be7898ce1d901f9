// SPDX-License-Identifier: Apache-2.0
#include "session/reading.h"

#include <algorithm>

#include "picture/seen.h"

namespace sconce {

std::vector<Rgb> layers_at(const EncodedLayers& layers, int page, Vec2 uv) {
  const TexelPlace x(uv.x, layers.width()), y(uv.y, layers.height());
  const int x1 = std::min(x.low + 1, layers.width() - 1), y1 = std::min(y.low + 1, layers.height() - 1);
  // Blocks are decoded four rows at a time.
  const int first = y.low & ~3, rows = std::min(8, layers.height() - first);
  std::vector<Rgb> found(layers.colors.size());
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    const LayerTexture& texture = layers.textures[t];
    if (texture.coefficient != 0) continue;
    const EncodedImage& image = layers.images[t][static_cast<std::size_t>(page)];
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<float> decoded(channels * static_cast<std::size_t>(rows) *
                               static_cast<std::size_t>(image.width));
    image.encoding->decode(image, first, rows, decoded.data());
    const auto between = [&](std::size_t channel) {
      const auto value = [&](int column, int row) {
        return decoded[channels *
                           (static_cast<std::size_t>(row - first) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(column)) +
                       channel];
      };
      const float top = (1 - x.fraction) * value(x.low, y.low) + x.fraction * value(x1, y.low);
      const float bottom = (1 - x.fraction) * value(x.low, y1) + x.fraction * value(x1, y1);
      return (1 - y.fraction) * top + y.fraction * bottom;
    };
    for (std::size_t i = 0; i < texture.groups.size(); ++i) {
      const std::size_t g = texture.groups[i];
      found[g] = texture.encoding.luminance ? between(i) * layers.colors[g]
                                            : Rgb(between(0), between(1), between(2));
    }
  }
  return found;
}

Reading read_pixel(const View& view, const EncodedLayers& layers, const MixSpec& mix, const Camera& camera,
                   const PictureParams& params, Vec2 at, const GroupPages& moved) {
  const Lens lens(camera, params);
  const Ray ray{lens.eye(), lens.direction(at)};
  const Hit hit = view.tracer().closest(ray);
  Reading reading;
  Rgb radiance, emission;
  if (hit) {
    const Scene& scene = view.scene();
    const SurfacePoint point = surface_point(view.world(), hit);
    const Shade surface = shade(scene, view.world(), hit.triangle, hit.barycentric);
    reading.surface = true;
    reading.position = point.position, reading.normal = point.shading_normal;
    reading.distance = hit.distance;
    reading.object = scene[view.world().instances[hit.triangle]].name;
    reading.material = scene[view.world().materials[hit.triangle]].name;
    reading.albedo = surface.receiver_albedo();
    emission = surface.emission;
    const LightmapSide& side = view.side(hit.triangle, hit.back);
    if (side.page >= 0) {
      const std::vector<Rgb> lux = layers_at(layers, side.page, side.at(hit.barycentric));
      for (std::size_t g = 0; g < lux.size(); ++g) {
        const auto relit = moved.find(g);
        const Rgb light = relit == moved.end() ? mix.weights.at(g) * lux[g]
                                               : bilinear(relit->second[static_cast<std::size_t>(side.page)],
                                                          side.at(hit.barycentric));
        reading.illuminance += light;
        reading.group_lux.push_back(luminance(light));
      }
    }
    radiance = reading.albedo * reading.illuminance * kInvPi;
  }
  for_each_shine(view.scene(), view.world(), ray, hit, emission,
                 [&](Id<LightGroup> group, const Rgb& shine) { radiance += weight_of(mix, group) * shine; });
  reading.luminance = luminance(radiance);
  return reading;
}

}  // namespace sconce
