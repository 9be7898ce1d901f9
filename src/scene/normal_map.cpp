// SPDX-License-Identifier: Apache-2.0
// Normal maps (glTF 2.0, 3.9.3 and 3.7.2.1).
#include "scene/world.h"

namespace sconce {

namespace {

/// Along u, and the sign that makes sign * cross(normal, tangent) the map's up.
struct Tangent {
  Vec3 along{0};
  float sign = 1;
};

Tangent given_tangent(const World& world, std::size_t triangle, Vec2 b) {
  if (world.tangents.empty()) return {};
  const auto& v = world.triangles[triangle].v;
  const glm::vec4 t =
      (1 - b.x - b.y) * world.tangents[v[0]] + b.x * world.tangents[v[1]] + b.y * world.tangents[v[2]];
  return {Vec3(t), t.w < 0 ? -1.0f : 1.0f};
}

/// From the gradient of the map's coordinates. Their v runs down, the map's y up.
Tangent texture_tangent(const World& world, std::size_t triangle, const TextureUse& use) {
  if (use.texcoord >= world.texcoords.size()) return {};
  const auto& v = world.triangles[triangle].v;
  const auto uv = [&](std::size_t k) { return use.transform(world.texcoords[use.texcoord][v[k]]); };
  const Vec3 e1 = world.positions[v[1]] - world.positions[v[0]],
             e2 = world.positions[v[2]] - world.positions[v[0]];
  const Vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const float area = d1.x * d2.y - d2.x * d1.y;
  if (area == 0) return {};
  const Vec3 u = (e1 * d2.y - e2 * d1.y) / area, down = (e2 * d1.x - e1 * d2.x) / area;
  return {u, glm::dot(glm::cross(world.face_normals[triangle], u), down) > 0 ? -1.0f : 1.0f};
}

}  // namespace

Vec3 normal_offset(const Scene& scene, const World& world, std::size_t triangle, Vec2 barycentric) {
  const Material& material = scene[world.materials[triangle]];
  const TextureUse& use = material.normal_texture;
  if (!use.texture.valid()) return Vec3(0);
  const Vec3 n = world.normal(triangle, barycentric);
  Tangent tangent = given_tangent(world, triangle, barycentric);
  if (tangent.along == Vec3(0)) tangent = texture_tangent(world, triangle, use);
  const Vec3 t = normalize_or(tangent.along - n * glm::dot(n, tangent.along), Vec3(0));
  if (t == Vec3(0)) return Vec3(0);
  const Rgb texel =
      sample_texture(scene, use, world.texcoord(triangle, barycentric, use.texcoord), false).rgb;
  const Vec3 local = 2.0f * Vec3(texel.r, texel.g, texel.b) - 1.0f;
  const Vec3 mapped =
      material.normal_scale * (local.x * t + local.y * tangent.sign * glm::cross(n, t)) + local.z * n;
  return normalize_or(mapped, n) - n;
}

}  // namespace sconce
