// SPDX-License-Identifier: Apache-2.0
#include "package/shown_scene.h"

#include <limits>

namespace sconce {

namespace {

/// Of an instance that is shown: its page, and the mesh that holds its back's lightmap coordinates.
struct Placement {
  int page = -1, twin_page = -1;
  Id<Mesh> twin;
};

std::vector<Placement> take_twins(Scene& scene, const Manifest& m) {
  std::vector<Placement> placements;
  std::vector<bool> is_twin(scene.instances.size(), false);
  std::vector<Instance> shown;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (is_twin[i]) continue;  // the lower node of a pair is its front
    Placement placement;
    placement.page = m.instance_pages[i];
    if (const int twin = m.instance_twins[i]; twin > static_cast<int>(i)) {
      const auto t = static_cast<std::size_t>(twin);
      is_twin[t] = true;
      placement.twin = scene.instances[t].mesh;
      placement.twin_page = m.instance_pages[t];
    }
    placements.push_back(placement);
    shown.push_back(std::move(scene.instances[i]));
  }
  scene.instances = std::move(shown);
  return placements;
}

LightmapSide front_side(const World& world, std::size_t triangle, const Placement& placement, uint32_t set) {
  LightmapSide side;
  side.page = placement.page;
  if (side.page < 0) return side;
  const std::vector<Vec2>& uvs = world.texcoords[set];
  for (std::size_t k = 0; k < 3; ++k) side.uv[k] = uvs[world.triangles[triangle].v[k]];
  return side;
}

// A twin has the triangles of its front in the same order, but winds them the other way: corners are told by
// position.
LightmapSide back_side(const Scene& scene, const World& world, std::size_t triangle,
                       const Placement& placement, uint32_t set) {
  LightmapSide side;
  side.page = placement.twin_page;
  if (side.page < 0) return side;
  const Mesh& twin = scene[placement.twin];
  const std::vector<Vec2>& uvs = twin.texcoords[set];
  const Mat4& transform = scene[world.instances[triangle]].transform;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 corner = world.positions[world.triangles[triangle].v[k]];
    float nearest = std::numeric_limits<float>::infinity();
    for (const uint32_t v : twin.triangles[world.source_triangles[triangle]].v) {
      const Vec3 d = Vec3(transform * glm::vec4(twin.positions[v], 1.0f)) - corner;
      if (glm::dot(d, d) >= nearest) continue;
      nearest = glm::dot(d, d);
      side.uv[k] = uvs[v];
    }
  }
  return side;
}

}  // namespace

ShownScene::ShownScene(const Package& package) : scene(package.scene()) {
  const Manifest& m = package.manifest();
  const std::vector<Placement> placements = take_twins(scene, m);
  world = make_world(scene);
  front.reserve(world.size());
  back.reserve(world.size());
  for (std::size_t t = 0; t < world.size(); ++t) {
    const Placement& placement = placements[world.instances[t].value];
    front.push_back(front_side(world, t, placement, m.lightmap_set));
    back.push_back(back_side(scene, world, t, placement, m.lightmap_set));
  }
}

}  // namespace sconce
