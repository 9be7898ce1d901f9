// SPDX-License-Identifier: Apache-2.0
#include "receive/mesh_graph.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace sconce {

namespace {

/// Per vertex: the first vertex of the same instance at the same place.
std::vector<uint32_t> weld(const World& world) {
  const std::size_t n = world.positions.size();
  std::vector<uint32_t> instance(n, 0), order(n), welded(n);
  for (std::size_t t = 0; t < world.size(); ++t)
    for (const uint32_t v : world.triangles[t].v) instance[v] = world.instances[t].value;
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t v) {
    const Vec3& p = world.positions[v];
    return std::tuple(instance[v], p.x, p.y, p.z);
  };
  // Unused vertices may hold NaN, which has no order; they are no triangle's corner.
  std::vector<uint8_t> used(n, 0);
  for (const Triangle& triangle : world.triangles)
    for (const uint32_t v : triangle.v) used[v] = 1;
  std::iota(welded.begin(), welded.end(), 0u);
  std::erase_if(order, [&](uint32_t v) { return used[v] == 0; });
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) welded[order[i]] = welded[order[i - 1]];
  return welded;
}

struct HalfEdge {
  uint32_t low, high, id;
  bool forward;  ///< runs from low to high
};

}  // namespace

Vec3 corner_normal(const World& world, std::size_t triangle, std::size_t k) {
  const Vec3& face = world.face_normals[triangle];
  const Vec3& n = world.normals[world.triangles[triangle].v[k]];
  if (n == Vec3(0)) return face;
  return glm::dot(n, face) < 0 ? -n : n;
}

MeshGraph make_mesh_graph(const World& world) {
  const std::vector<uint32_t> welded = weld(world);
  MeshGraph graph;
  const std::size_t n = world.size();
  graph.mates.assign(3 * n, MeshGraph::kNone);
  graph.turn.assign(3 * n, -1.0f);
  graph.normals.resize(n);
  graph.areas.resize(n);

  std::vector<HalfEdge> edges;
  edges.reserve(3 * n);
  for (uint32_t t = 0; t < n; ++t) {
    const auto& v = world.triangles[t].v;
    float longest = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = welded[v[k]], b = welded[v[next_corner(k)]];
      const Vec3 d = world.positions[a] - world.positions[b];
      longest = std::max(longest, glm::dot(d, d));
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), 3 * t + k, a < b});
    }
    graph.areas[t] = world.area(t);
    // Thinner than 1 : 1000: the cross product is mostly rounding, the file's own normals know better.
    const bool thin = 2 * graph.areas[t] < 1e-3f * longest;
    const Vec3 sum = corner_normal(world, t, 0) + corner_normal(world, t, 1) + corner_normal(world, t, 2);
    graph.normals[t] = thin ? normalize_or(sum, world.face_normals[t]) : world.face_normals[t];
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tuple(a.low, a.high, a.id) < std::tuple(b.low, b.high, b.id);
  });

  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (end - i == 2 && edges[i].forward != edges[i + 1].forward) {
      const uint32_t a = edges[i].id, b = edges[i + 1].id;
      graph.mates[a] = b;
      graph.mates[b] = a;
      // The edge's start on one side is its end on the other.
      const float cos_start =
          glm::dot(corner_normal(world, a / 3, a % 3), corner_normal(world, b / 3, next_corner(b % 3)));
      const float cos_end =
          glm::dot(corner_normal(world, a / 3, next_corner(a % 3)), corner_normal(world, b / 3, b % 3));
      graph.turn[a] = graph.turn[b] = std::min(cos_start, cos_end);
    }
    i = end;
  }
  return graph;
}

}  // namespace sconce
