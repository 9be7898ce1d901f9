// SPDX-License-Identifier: Apache-2.0
#include "detect/ambient_map.h"

namespace sconce {

namespace {

Atlas one_atlas(const TracedScene& traced, float density) {
  AtlasParams params;
  params.density = density;
  return make_atlas(traced.scene, traced.world, traced.tracer, params);
}

constexpr int kRings = 3;  // of texels around a face

}  // namespace

AmbientMap::AmbientMap(Scene scene, float density)
    : scene_(std::move(scene)),
      world_(make_world(scene_)),
      tracer_(scene_, world_),
      traced_{scene_, world_, tracer_},
      atlas_(one_atlas(traced_, density)),
      space_(atlas_space(atlas_)) {}

std::vector<std::array<Vec2, 3>> AmbientMap::coordinates() const {
  std::vector<std::array<Vec2, 3>> all(world_.size(), {Vec2(0), Vec2(0), Vec2(0)});
  const Vec2 whole(static_cast<float>(space_.width), static_cast<float>(space_.height));
  for (std::size_t i = 0; i < space_.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) all[space_.triangles[i]][c] = space_.corners[i][c] / whole;
  return all;
}

void AmbientMap::start(const HostRenderer& host, TransferParams params, const Progress& progress,
                       const DetectParams& look) {
  params.keep_sums = true;
  detection_ = detect_materials(scene_, world_, host, look, progress);
  radiosity_ = std::make_unique<RealtimeRadiosity>(traced_, texel_receivers(traced_, atlas_), space_, host,
                                                   detection_, params, progress);
  reflectance_.assign(space_.pixels(), Rgb());
  std::vector<std::size_t> known;
  for (std::size_t f = 0; f < space_.triangles.size(); ++f) {
    const auto& [a, b, c] = space_.corners[f];
    const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
    each_pixel(space_, f, [&](std::size_t pixel) {
      reflectance_[pixel] =
          detection_.at(world_, space_.triangles[f], inverse * (pixel_middle(space_, pixel) - a)).reflectance;
      known.push_back(pixel);
    });
  }
  std::vector<uint8_t> done = space_.covered;
  const auto width = static_cast<std::size_t>(space_.width);
  for (int ring = 0; ring < kRings; ++ring)
    for (std::size_t i = 0, end = known.size(); i < end; ++i)
      for (const std::size_t to : {known[i] - 1, known[i] + 1, known[i] - width, known[i] + width})
        if (to < done.size() && !done[to]) {  // below 0 is beyond the end
          done[to] = 1, reflectance_[to] = reflectance_[known[i]];
          known.push_back(to);
        }
}

std::vector<Rgb> AmbientMap::reflected() const {
  std::vector<Rgb> light(texels().begin(), texels().end());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] *= reflectance_[i];
  return light;
}

}  // namespace sconce
