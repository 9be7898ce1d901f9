// SPDX-License-Identifier: Apache-2.0
#include "session/standing.h"

#include <algorithm>

namespace sconce {

namespace {

/// An emissive mesh goes dark; others of its mesh and material stay.
void put_out(Scene& scene, Instance& instance) {
  Mesh mesh = scene[instance.mesh];
  Material dark = scene[mesh.material];
  dark.emission = Rgb(0);
  scene.materials.push_back(std::move(dark));
  mesh.material = Id<Material>(scene.materials.size() - 1);
  scene.meshes.push_back(std::move(mesh));
  instance.mesh = Id<Mesh>(scene.meshes.size() - 1);
}

}  // namespace

Scene standing_scene(const Scene& from, const World& world, std::span<const StandingLamp> lamps) {
  Scene scene = from;
  const Lamps home(from, world);
  for (const StandingLamp& one : lamps) {
    const Lamp& lamp = home.all()[one.lamp];
    const auto* mesh = std::get_if<MeshLamp>(&lamp.shape);
    Instance* instance =
        mesh != nullptr ? &scene.instances[world.instances[mesh->first_triangle].value] : nullptr;
    if (one.itself) {
      Mat4& frame = instance != nullptr ? instance->transform : scene.lights[one.lamp].frame;
      frame = one.motion * frame;
      continue;
    }
    if (instance != nullptr)
      put_out(scene, *instance);
    else
      scene.lights[one.lamp].intensity = Rgb(0);
    if (!one.other) continue;
    MoreLights other = *one.other;
    for (Light& light : other.lights) {
      light.group = lamp.group;
      if (light.name.empty()) light.name = lamp.name;
    }
    append(scene, std::move(other));
  }
  std::erase_if(scene.lights, [](const Light& light) { return light.intensity.is_black(); });
  return scene;
}

void add_group(Scene& scene, const std::string& name, MoreLights lights) {
  scene.groups.push_back({name});
  for (Light& light : lights.lights) light.group = Id<LightGroup>(scene.groups.size() - 1);
  append(scene, std::move(lights));
}

StandingScene::StandingScene(Scene scene)
    : scene_(std::move(scene)), world_(make_world(scene_)), tracer_(scene_, world_) {}

}  // namespace sconce
