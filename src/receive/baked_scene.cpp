// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <tuple>

#include "receive/atlas.h"

namespace sconce {

namespace {

/// World triangles of one primitive of the baked scene: one instance, one page in front, one or none behind.
struct Part {
  Id<Instance> instance;
  int front_page, back_page;
  std::vector<uint32_t> triangles;
};

std::vector<Part> split(const World& world, const Atlas& atlas) {
  std::map<std::tuple<uint32_t, int, int>, Part> parts;
  for (uint32_t t = 0; t < world.size(); ++t) {
    const int front = atlas.front[t].page, back = atlas.back[t].page;
    Part& part = parts[{world.instances[t].value, front, back}];
    part.instance = world.instances[t];
    part.front_page = front, part.back_page = back;
    part.triangles.push_back(t);
  }
  std::vector<Part> result;
  for (auto& [key, part] : parts) result.push_back(std::move(part));
  return result;
}

/// The part's mesh in world space as seen from one side. Vertices are shared where source vertex and place in
/// the lightmap agree.
Mesh make_mesh(const World& world, const Atlas& atlas, const Part& part, const Mesh& source, bool back) {
  Mesh mesh;
  mesh.name = source.name;
  mesh.material = source.material;
  const std::size_t sets = world.texcoords.size();
  mesh.texcoords.resize(sets + 1);
  const Vec2 page(static_cast<float>(atlas.width), static_cast<float>(atlas.height));
  const float sign = back ? -1.0f : 1.0f;
  const bool has_page = (back ? part.back_page : part.front_page) >= 0;
  // Without any normals a mesh stays without: face normals. Where only some are missing, corners get their
  // face's.
  bool any_normal = false;
  const bool any_tangent = !source.tangents.empty();
  for (const uint32_t t : part.triangles)
    for (const uint32_t v : world.triangles[t].v) any_normal = any_normal || world.normals[v] != Vec3(0);

  std::map<std::tuple<uint32_t, float, float, uint32_t>, uint32_t> shared;
  for (const uint32_t t : part.triangles) {
    const TexelTriangle& side = (back ? atlas.back : atlas.front)[t];
    std::array<uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const uint32_t v = world.triangles[t].v[k];
      const Vec2 uv = has_page ? glm::clamp(side.uv[k] / page, Vec2(0), Vec2(1)) : Vec2(0);
      const bool own_normal = any_normal && world.normals[v] == Vec3(0);
      const auto [it, fresh] = shared.try_emplace({v, uv.x, uv.y, own_normal ? t + 1 : 0u},
                                                  static_cast<uint32_t>(mesh.positions.size()));
      if (fresh) {
        mesh.positions.push_back(world.positions[v]);
        if (any_tangent) {
          // The back's normals are the front's, all of their frame turned round.
          const glm::vec4& tangent = world.tangents[v];
          mesh.tangents.push_back(sign * tangent);
        }
        if (any_normal)
          mesh.normals.push_back(sign * (own_normal ? world.face_normals[t] : world.normals[v]));
        for (std::size_t s = 0; s < sets; ++s) mesh.texcoords[s].push_back(world.texcoords[s][v]);
        mesh.texcoords[sets].push_back(uv);
      }
      corners[k] = it->second;
    }
    if (back) std::swap(corners[1], corners[2]);
    mesh.triangles.push_back({corners});
  }
  return mesh;
}

}  // namespace

BakedScene make_baked_scene(const Scene& scene, const World& world, const Atlas& atlas) {
  BakedScene baked;
  Scene& out = baked.scene;
  out.name = scene.name;
  out.textures = scene.textures;
  out.materials = scene.materials;
  out.luminaires = scene.luminaires;
  out.lights = scene.lights;
  out.groups = scene.groups;
  out.cameras = scene.cameras;
  baked.lightmap_set = static_cast<uint32_t>(world.texcoords.size());

  const std::vector<Part> parts = split(world, atlas);
  const auto add = [&](const Part& part, bool back) {
    const Instance& source = scene[part.instance];
    const Id<Mesh> mesh(out.meshes.size());
    out.meshes.push_back(make_mesh(world, atlas, part, scene[source.mesh], back));
    Instance instance = source;
    instance.mesh = mesh;
    instance.transform = Mat4(1.0f);
    out.instances.push_back(std::move(instance));
    baked.pages.push_back(back ? part.back_page : part.front_page);
    baked.twins.emplace_back();
    return Id<Instance>(out.instances.size() - 1);
  };
  for (const Part& part : parts) add(part, false);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].back_page >= 0) baked.twins[i] = add(parts[i], true);
  return baked;
}

}  // namespace sconce
