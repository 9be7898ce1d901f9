// SPDX-License-Identifier: Apache-2.0
#include "session/opened_picture.h"

#include <fmt/format.h>

#include "core/error.h"
#include "session/reading.h"

namespace sconce {

namespace {

LayeredImage read_layered(const std::filesystem::path& path, const std::string& groups_from) {
  return find_layers(read_exr_parts(path), path.string(), groups_from);
}

EncodedLayers layers_of(const LayeredImage& picture) {
  const std::size_t groups = picture.groups.size();
  return encode_layers(std::vector(groups, parse_encoding("f32")), 1, std::vector(groups, Rgb(1)),
                       [&](std::size_t g, int) {
                         MixSpec alone{std::vector<Rgb>(groups, Rgb(0))};
                         alone.weights[g] = Rgb(1);
                         return shown(picture, mix_layers(picture, alone));
                       });
}

}  // namespace

OpenedPicture::OpenedPicture(const std::filesystem::path& path, const std::string& groups_from)
    : picture(read_layered(path, groups_from)), layers(layers_of(picture)) {
  for (std::size_t g = 0; g < picture.groups.size(); ++g) {
    double sum = 0;
    const Image layer = layers.layer(g).front();
    for (std::size_t i = 0; i < layer.pixels(); ++i)
      sum += luminance(Rgb(layer.data[3 * i], layer.data[3 * i + 1], layer.data[3 * i + 2]));
    means.push_back(static_cast<float>(sum / static_cast<double>(layer.pixels())));
  }
}

PictureReading read_pixel(const OpenedPicture& opened, const MixSpec& mix, Vec2 at) {
  const Vec2 uv = (glm::floor(at) + 0.5f) / Vec2(opened.width(), opened.height());
  PictureReading reading;
  const std::vector<Rgb> groups = layers_at(opened.layers, 0, uv);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Rgb light = mix.weights.at(g) * groups[g];
    reading.value += light;
    reading.groups.push_back(luminance(light));
  }
  return reading;
}

void wish_picture(Wishes& wishes, const OpenedPicture& opened, std::span<const Rgb> unit,
                  const Image& target) {
  if (target.width != opened.width() || target.height != opened.height())
    throw Error({}, fmt::format("the picture to look like is {} x {}", target.width, target.height),
                fmt::format("{} x {}, the same view", opened.width(), opened.height()));
  std::vector<Image> parts;
  for (std::size_t g = 0; g < unit.size(); ++g) parts.push_back(fit_sized(opened.layers.layer(g).front()));
  wish_pixels(wishes, parts, unit, fit_sized(target));
}

}  // namespace sconce
