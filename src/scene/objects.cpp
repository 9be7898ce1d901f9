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

SurfacePoint Placement::there(SurfacePoint at) const {
  return {point(at.position), direction(at.shading_normal), direction(at.geometric_normal)};
}

SurfacePoint Placement::home(SurfacePoint at) const {
  const Mat3 back = glm::transpose(turn);
  return {back * (at.position - shift), back * at.shading_normal, back * at.geometric_normal};
}

ObjectPlaces::ObjectPlaces(const Scene& scene, const World& world)
    : positions_(world.positions),
      normals_(world.normals),
      tangents_(world.tangents),
      face_normals_(world.face_normals) {
  for (const Instance& instance : scene.instances) transforms_.push_back(instance.transform);
  std::map<std::string, Bounds> bounds;
  for (std::size_t t = 0; t < world.size(); ++t)
    for (const uint32_t v : world.triangles[t].v)
      bounds[scene[world.instances[t]].name].add(world.positions[v]);
  for (const auto& [name, box] : bounds) middles_[name] = box.center();
}

std::vector<Placement> ObjectPlaces::placements(const Scene& scene, const ObjectMoves& moves) const {
  std::vector<Placement> out(scene.instances.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto move = moves.find(scene.instances[i].name);
    const auto middle = middles_.find(scene.instances[i].name);
    if (move == moves.end() || middle == middles_.end()) continue;
    const float angle = move->second.turn * kPi / 180, c = std::cos(angle), s = std::sin(angle);
    out[i].turn = Mat3(c, 0, -s, 0, 1, 0, s, 0, c);
    out[i].shift = move->second.by + (middle->second - out[i].turn * middle->second);
  }
  return out;
}

void ObjectPlaces::place(const ObjectMoves& moves, Scene& scene, World& world) const {
  const std::vector<Placement> to = placements(scene, moves);
  for (std::size_t i = 0; i < to.size(); ++i) {
    Mat4 matrix(to[i].turn);
    matrix[3] = {to[i].shift, 1};
    scene.instances[i].transform = matrix * transforms_[i];
  }
  world.bounds = {};
  for (std::size_t t = 0; t < world.size(); ++t) {
    const Placement& p = to[world.instances[t].value];
    world.face_normals[t] = p.direction(face_normals_[t]);
    for (const uint32_t v : world.triangles[t].v) {
      world.positions[v] = p.point(positions_[v]);
      world.normals[v] = p.direction(normals_[v]);
      if (!tangents_.empty()) world.tangents[v] = {p.direction(Vec3(tangents_[v])), tangents_[v].w};
      world.bounds.add(world.positions[v]);
    }
  }
}

}  // namespace sconce
