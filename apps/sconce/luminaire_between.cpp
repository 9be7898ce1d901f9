// SPDX-License-Identifier: Apache-2.0
#include "luminaire_between.h"

#include "core/sobol.h"
#include "import/import.h"
#include "scene/groups.h"

namespace sconce::app {

namespace {

Vec3 to_scene(const Vec3& v) {
  return {v.x, v.z, -v.y};
}

Scene without_lamps(const std::string& file, const Progress& progress) {
  Progress quiet = progress;
  quiet.warning = nullptr;  // that it has no lamps, and how its surfaces look, does not matter
  Scene scene = import_scene(file, quiet);
  scene.lights.clear();
  for (Material& material : scene.materials) material.emission = Rgb();
  return scene;
}

}  // namespace

Between::Between(const std::string& scene, const Progress& progress)
    : scene_(without_lamps(scene, progress)), world_(make_world(scene_)), tracer_(scene_, world_) {}

void Between::hang(Luminaire lamp, double exact_below) {
  scene_.luminaires.push_back(std::move(lamp));
  Light light;
  light.intensity = Rgb(1);
  light.shape = LuminaireLight{Id<Luminaire>(scene_.luminaires.size() - 1), static_cast<float>(exact_below)};
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0);
    axis[i] = 1;
    light.frame[i] = glm::vec4(to_scene(axis), 0);
  }
  scene_.lights.push_back(light);
  assign_groups(scene_, Grouping::one);
  lamps_.emplace(scene_, world_);
}

Rgb Between::lux(const Vec3& x, int rays, uint32_t seed) const {
  const Vec3 at = to_scene(x);
  Rgb sum;
  for (int i = 0; i < rays; ++i) {
    LightSample light;
    if (!lamps_->sample(0, at, sobol_pair(static_cast<uint32_t>(i), 0, seed), light)) continue;
    const float cosine = light.direction.y;
    if (cosine > 0)
      sum += cosine * light.radiance * tracer_.transmittance({at, light.direction, light.distance});
  }
  return sum / static_cast<float>(rays);
}

Rgb Between::passed(const Vec3& from, const Vec3& direction, double distance) const {
  return tracer_.transmittance({to_scene(from), to_scene(direction), static_cast<float>(distance)});
}

}  // namespace sconce::app
