// SPDX-License-Identifier: Apache-2.0
#include "scene/world.h"

#include <algorithm>

#include "core/error.h"

namespace sconce {

namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

World make_world(const Scene& scene) {
  World world;
  std::size_t sets = 0;
  bool tangents = false;
  for (const Mesh& mesh : scene.meshes) {
    sets = std::max(sets, mesh.texcoords.size());
    tangents |= !mesh.tangents.empty();
  }
  world.texcoords.resize(sets);

  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene[instance.mesh];
    const Mat3 linear(instance.transform);
    const bool mirrored = glm::determinant(linear) < 0;
    // Cofactors serve as the normal matrix and need no inverse, so a flattened instance is no special case.
    const Mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                         glm::cross(linear[0], linear[1]));
    const auto base = static_cast<uint32_t>(world.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      world.positions.push_back(Vec3(instance.transform * glm::vec4(mesh.positions[v], 1.0f)));
      const Vec3 n = v < mesh.normals.size() ? cofactors * mesh.normals[v] : Vec3(0);
      world.normals.push_back(normalize_or(mirrored ? -n : n, Vec3(0)));
      if (tangents) {
        const glm::vec4 t = v < mesh.tangents.size() ? mesh.tangents[v] : glm::vec4(0);
        world.tangents.emplace_back(normalize_or(linear * Vec3(t), Vec3(0)), mirrored ? -t.w : t.w);
      }
      for (std::size_t s = 0; s < sets; ++s) {
        const bool has = s < mesh.texcoords.size() && v < mesh.texcoords[s].size();
        world.texcoords[s].push_back(has ? mesh.texcoords[s][v] : Vec2(0));
      }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      auto [a, b, c] = mesh.triangles[t].v;
      if (mirrored) std::swap(b, c);
      const Vec3 &p0 = world.positions[base + a], &p1 = world.positions[base + b],
                 &p2 = world.positions[base + c];
      if (!finite(p0) || !finite(p1) || !finite(p2)) continue;
      const Vec3 cross = glm::cross(p1 - p0, p2 - p0);
      const float twice_area = glm::length(cross);
      const float longest =
          std::max({glm::dot(p1 - p0, p1 - p0), glm::dot(p2 - p1, p2 - p1), glm::dot(p0 - p2, p0 - p2)});
      if (!(twice_area > 1e-7f * longest) || !(twice_area > 1e-14f)) continue;
      world.triangles.push_back({{base + a, base + b, base + c}});
      world.face_normals.push_back(cross / twice_area);
      world.instances.emplace_back(i);
      world.materials.push_back(mesh.material);
      world.source_triangles.push_back(static_cast<uint32_t>(t));
      for (const Vec3& p : {p0, p1, p2}) world.bounds.add(p);
    }
  }
  if (world.triangles.empty()) throw Error(scene.name, "the scene has no triangles");
  return world;
}

float World::area(std::size_t t) const {
  const auto& v = triangles[t].v;
  return 0.5f * glm::length(glm::cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]));
}

Vec3 World::position(std::size_t t, Vec2 b) const {
  const auto& v = triangles[t].v;
  return (1.0f - b.x - b.y) * positions[v[0]] + b.x * positions[v[1]] + b.y * positions[v[2]];
}

Vec3 World::normal(std::size_t t, Vec2 b) const {
  const auto& v = triangles[t].v;
  const Vec3 n = (1.0f - b.x - b.y) * normals[v[0]] + b.x * normals[v[1]] + b.y * normals[v[2]];
  const Vec3 unit = normalize_or(n, face_normals[t]);
  return glm::dot(unit, face_normals[t]) < 0 ? -unit : unit;
}

Vec2 World::texcoord(std::size_t t, Vec2 b, uint32_t set) const {
  if (set >= texcoords.size()) return Vec2(0);
  const auto& v = triangles[t].v;
  return (1.0f - b.x - b.y) * texcoords[set][v[0]] + b.x * texcoords[set][v[1]] + b.y * texcoords[set][v[2]];
}

}  // namespace sconce
