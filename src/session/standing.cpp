// SPDX-License-Identifier: Apache-2.0
#include "session/standing.h"

#include <algorithm>

#include "relight/lamp_move.h"

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

Scene moved(const Scene& from, const World& world, std::span<const StandingLamp> standing) {
  Scene scene = from;
  const Lamps lamps(from, world);
  const std::vector<std::string> names = lamp_names(lamps);
  for (const StandingLamp& one : standing) {
    const Lamp& lamp = lamps.all()[one.lamp];
    const auto* mesh = std::get_if<MeshLamp>(&lamp.shape);
    Instance* instance =
        mesh != nullptr ? &scene.instances[world.instances[mesh->first_triangle].value] : nullptr;
    if (one.state.kind.empty()) {
      Mat4& frame = instance != nullptr ? instance->transform : scene.lights[one.lamp].frame;
      const std::size_t some[] = {one.lamp};
      frame = motion_to(lamps, some, {one.state.at, one.state.target}, names[one.lamp], "target") * frame;
      continue;
    }
    if (instance != nullptr)
      put_out(scene, *instance);
    else
      scene.lights[one.lamp].intensity = Rgb(0);
    if (!one.other) continue;
    MoreLights other = *one.other;
    for (Light& light : other.lights) light.group = lamp.group;
    append(scene, std::move(other));
  }
  std::erase_if(scene.lights, [](const Light& light) { return light.intensity.is_black(); });
  return scene;
}

}  // namespace

StandingScene::StandingScene(const Scene& scene, const World& world, std::span<const StandingLamp> lamps)
    : scene_(moved(scene, world, lamps)), world_(make_world(scene_)), tracer_(scene_, world_) {}

}  // namespace sconce
