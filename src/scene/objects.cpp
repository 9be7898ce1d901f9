// SPDX-License-Identifier: Apache-2.0
#include "scene/objects.h"

#include <set>

namespace sconce {

std::vector<std::string> object_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Instance& instance : scene.instances)
    if (!instance.name.empty()) names.insert(instance.name);
  return {names.begin(), names.end()};
}

Bounds object_bounds(const Scene& scene, const World& world, const std::string& name) {
  Bounds bounds;
  for (std::size_t t = 0; t < world.size(); ++t)
    if (scene[world.instances[t]].name == name)
      for (const uint32_t v : world.triangles[t].v) bounds.add(world.positions[v]);
  return bounds;
}

ObjectPlaces::ObjectPlaces(const Scene& scene, const World& world) : positions_(world.positions) {
  for (const Instance& instance : scene.instances) transforms_.push_back(instance.transform);
}

void ObjectPlaces::place(const ObjectMoves& moves, Scene& scene, World& world) const {
  std::vector<Vec3> by(scene.instances.size(), Vec3(0));
  for (std::size_t i = 0; i < by.size(); ++i) {
    const auto move = moves.find(scene.instances[i].name);
    if (move != moves.end()) by[i] = move->second;
    scene.instances[i].transform = transforms_[i];
    scene.instances[i].transform[3] += glm::vec4(by[i], 0);
  }
  world.positions = positions_, world.bounds = {};
  std::vector<bool> done(positions_.size(), false);
  for (std::size_t t = 0; t < world.size(); ++t)
    for (const uint32_t v : world.triangles[t].v) {
      if (!done[v]) world.positions[v] += by[world.instances[t].value];
      done[v] = true;
      world.bounds.add(world.positions[v]);
    }
}

}  // namespace sconce
