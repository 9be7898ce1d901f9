// SPDX-License-Identifier: Apache-2.0
// Normal maps (glTF 2.0, 3.9.3 and 3.7.2.1).
#include <algorithm>

#include "scene/world.h"

namespace sconce {

namespace {

/// From the gradient of the map's coordinates; 0 where it has none. Their v runs down, the map's y up.
glm::vec4 texture_tangent(const World& world, std::size_t triangle, const TextureUse& use) {
  if (use.texcoord >= world.texcoords.size()) return glm::vec4(0);
  const auto& v = world.triangles[triangle].v;
  const auto uv = [&](std::size_t k) { return use.transform(world.texcoords[use.texcoord][v[k]]); };
  const Vec3 e1 = world.positions[v[1]] - world.positions[v[0]],
             e2 = world.positions[v[2]] - world.positions[v[0]];
  const Vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const float area = d1.x * d2.y - d2.x * d1.y;
  if (area == 0) return glm::vec4(0);
  const Vec3 u = (e1 * d2.y - e2 * d1.y) / area, down = (e2 * d1.x - e1 * d2.x) / area;
  return {u, glm::dot(glm::cross(world.face_normals[triangle], u), down) > 0 ? -1.0f : 1.0f};
}

}  // namespace

std::array<glm::vec4, 3> map_tangents(const Scene& scene, const World& world, std::size_t triangle) {
  std::array<glm::vec4, 3> tangents{};
  if (!world.tangents.empty())
    for (std::size_t k = 0; k < 3; ++k) tangents[k] = world.tangents[world.triangles[triangle].v[k]];
  const auto none = [](const glm::vec4& t) { return Vec3(t) == Vec3(0); };
  if (std::all_of(tangents.begin(), tangents.end(), none))
    tangents.fill(texture_tangent(world, triangle, scene[world.materials[triangle]].normal_texture));
  return tangents;
}

Vec3 normal_offset(const Scene& scene, const World& world, std::size_t triangle, Vec2 barycentric) {
  const Material& material = scene[world.materials[triangle]];
  const TextureUse& use = material.normal_texture;
  if (!use.texture.valid()) return Vec3(0);
  const Vec3 n = world.normal(triangle, barycentric);
  const std::array<glm::vec4, 3> corners = map_tangents(scene, world, triangle);
  const glm::vec4 tangent = (1 - barycentric.x - barycentric.y) * corners[0] + barycentric.x * corners[1] +
                            barycentric.y * corners[2];
  const Vec3 along(tangent), t = normalize_or(along - n * glm::dot(n, along), Vec3(0));
  if (t == Vec3(0)) return Vec3(0);
  const Rgb texel =
      sample_texture(scene, use, world.texcoord(triangle, barycentric, use.texcoord), false).rgb;
  const Vec3 local = 2.0f * Vec3(texel.r, texel.g, texel.b) - 1.0f;
  const Vec3 mapped =
      material.normal_scale * (local.x * t + local.y * (tangent.w < 0 ? -1.0f : 1.0f) * glm::cross(n, t)) +
      local.z * n;
  return normalize_or(mapped, n) - n;
}

}  // namespace sconce
