// SPDX-License-Identifier: Apache-2.0
#include "gpu/surface_vertices.h"

#include <map>

namespace sconce::gpu {

std::vector<SurfaceBatch> surface_batches(const ShownScene& shown) {
  const World& world = shown.world;
  std::map<std::pair<uint32_t, uint32_t>, SurfaceBatch> batches;
  for (uint32_t t = 0; t < world.size(); ++t) {
    const Id<Material> material = world.materials[t];
    const Id<LightGroup> group =
        shown.scene[material].emits() ? shown.scene[world.instances[t]].group : Id<LightGroup>();
    SurfaceBatch& batch = batches[{material.value, group.value}];
    batch.material = material;
    batch.group = group;
    batch.triangles.push_back(t);
  }
  std::vector<SurfaceBatch> sorted;
  for (auto& [key, batch] : batches) sorted.push_back(std::move(batch));
  return sorted;
}

Vec2 place_in(const TextureUse& use, const World& world, std::size_t triangle, std::size_t corner) {
  const uint32_t v = world.triangles[triangle].v[corner];
  return use.transform(use.texcoord < world.texcoords.size() ? world.texcoords[use.texcoord][v] : Vec2(0));
}

SurfaceVertex surface_vertex(const ShownScene& shown, std::size_t triangle, std::size_t corner) {
  const World& world = shown.world;
  const Material& material = shown.scene[world.materials[triangle]];
  const auto place = [&](const TextureUse& use) { return place_in(use, world, triangle, corner); };
  const auto in_lightmap = [&](const LightmapSide& side) {
    return Vec3(side.uv[corner], static_cast<float>(side.page));
  };
  return {world.positions[world.triangles[triangle].v[corner]],
          place(material.base_color_texture),
          place(material.metallic_roughness_texture),
          place(material.emission_texture),
          in_lightmap(shown.front[triangle]),
          in_lightmap(shown.back[triangle])};
}

}  // namespace sconce::gpu
