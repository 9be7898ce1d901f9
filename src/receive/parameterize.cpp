// SPDX-License-Identifier: Apache-2.0
#include "receive/parameterize.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sconce {

namespace {

constexpr float kFlat = 0.9945f;         // cos 6 deg: planar projection shortens by at most 0.6 %
constexpr double kMostStretch = 1.25;    // L2, over a chart
constexpr double kFlipTolerance = 1e-4;  // share of a chart's area that slivers may turn over
constexpr float kJoined = 0.5f;          // cos 60 deg: sharper edges stay cut inside a patch

bool folds(const Chart& chart) {
  double turned = 0, total = 0;
  for (const auto& t : chart.uv) {
    const double a = static_cast<double>(signed_area(t));
    if (!std::isfinite(a)) return true;
    total += std::abs(a);
    if (a <= 0) turned -= a;
  }
  return !(total > 0) || turned > kFlipTolerance * total;
}

void project(const World& world, const Vec3& axis, Chart& chart) {
  const Frame frame(axis);
  chart.uv.clear();
  const Vec3 origin = world.positions[world.triangles[chart.triangles.front()].v[0]];
  for (const uint32_t t : chart.triangles) {
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = world.positions[world.triangles[t].v[k]] - origin;
      uv[k] = Vec2(glm::dot(p, frame.x), glm::dot(p, frame.y));
    }
    chart.uv.push_back(uv);
  }
}

bool map_conformally(const World& world, const MeshGraph& graph, Chart& chart) {
  const PatchMesh mesh = make_patch_mesh(world, graph, chart.triangles);
  const std::vector<Vec2> flat = conformal_map(mesh);
  if (flat.empty()) return false;
  chart.uv.clear();
  for (const auto& c : mesh.corners) chart.uv.push_back({flat[c[0]], flat[c[1]], flat[c[2]]});
  return !folds(chart);
}

void scale_to_area(Chart& chart) {
  double flat = 0;
  for (const auto& t : chart.uv) flat += std::abs(static_cast<double>(signed_area(t)));
  if (!(flat > 0)) return;
  const auto factor = static_cast<float>(std::sqrt(chart.area / flat));
  for (auto& t : chart.uv)
    for (Vec2& p : t) p *= factor;
}

}  // namespace

double l2_stretch(const World& world, const MeshGraph& graph, const Chart& chart) {
  double sum = 0, surface = 0, flat = 0;
  for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
    const auto& v = world.triangles[chart.triangles[i]].v;
    const auto& t = chart.uv[i];
    const double area = std::abs(static_cast<double>(signed_area(t)));
    const double world_area = static_cast<double>(graph.areas[chart.triangles[i]]);
    if (area < 1e-3 * world_area) continue;  // a sliver that was laid edge-on
    const Vec2 a = t[1] - t[0], b = t[2] - t[0];
    const float d = cross2(a, b);
    const Vec3 p = world.positions[v[1]] - world.positions[v[0]],
               q = world.positions[v[2]] - world.positions[v[0]];
    const Vec3 su = (p * b.y - q * a.y) / d, sv = (q * a.x - p * b.x) / d;
    sum += world_area * 0.5 * static_cast<double>(glm::dot(su, su) + glm::dot(sv, sv));
    surface += world_area;
    flat += area;
  }
  return surface > 0 ? std::sqrt(sum / surface * flat / surface) : 1.0;
}

void Chart::settle() {
  Vec2 lo(1e30f), hi(-1e30f);
  for (const auto& t : uv)
    for (const Vec2& p : t) lo = glm::min(lo, p), hi = glm::max(hi, p);
  for (auto& t : uv)
    for (Vec2& p : t) p -= lo;
  size = hi - lo;
}

PatchMesh make_patch_mesh(const World& world, const MeshGraph& graph, const Patch& patch) {
  const std::size_t n = patch.size();
  std::vector<uint32_t> parent(3 * n);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto join = [&](uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  };
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = graph.mates[3 * patch[i] + k];
      if (mate == MeshGraph::kNone || graph.turn[3 * patch[i] + k] < kJoined) continue;
      const auto it = std::lower_bound(patch.begin(), patch.end(), mate / 3);
      if (it == patch.end() || *it != mate / 3) continue;
      const auto j = static_cast<uint32_t>(it - patch.begin());
      join(3 * i + k, 3 * j + next_corner(mate % 3));
      join(3 * i + next_corner(k), 3 * j + mate % 3);
    }
  }
  PatchMesh mesh;
  mesh.corners.resize(n);
  std::vector<uint32_t> number(3 * n, MeshGraph::kNone);
  for (uint32_t c = 0; c < 3 * n; ++c) {
    const uint32_t r = root(c);
    if (number[r] == MeshGraph::kNone) {
      number[r] = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.push_back(world.positions[world.triangles[patch[c / 3]].v[c % 3]]);
    }
    mesh.corners[c / 3][c % 3] = number[r];
  }
  return mesh;
}

void parameterize(const World& world, const MeshGraph& graph, const Patch& patch,
                  std::vector<Chart>& charts) {
  Chart chart;
  chart.triangles = patch;
  Vec3 sum(0);
  for (const uint32_t t : patch) {
    chart.area += static_cast<double>(graph.areas[t]);
    sum += graph.areas[t] * graph.normals[t];
  }
  const Vec3 axis =
      patch.size() == 1 ? world.face_normals[patch[0]] : normalize_or(sum, graph.normals[patch[0]]);
  float least = 1;
  for (const uint32_t t : patch) least = std::min(least, glm::dot(graph.normals[t], axis));

  bool good = false;
  if (least > kFlat || patch.size() == 1) {
    project(world, axis, chart);
    good = !folds(chart);
  }
  if (!good) good = map_conformally(world, graph, chart);
  if (!good && least > 0.8f) {
    project(world, axis, chart);
    good = !folds(chart);
  }
  if (good) {
    scale_to_area(chart);
    chart.stretch = l2_stretch(world, graph, chart);
    good = chart.stretch <= kMostStretch && !overlaps_itself(chart.uv);
  }
  if (!good && patch.size() > 1) {
    const auto [a, b] = halve(world, graph, patch);
    parameterize(world, graph, a, charts);
    parameterize(world, graph, b, charts);
    return;
  }
  turn_to_smallest_rectangle(chart.uv);
  chart.settle();
  charts.push_back(std::move(chart));
}

Chart make_twin(const Chart& chart) {
  Chart twin = chart;
  twin.back = true;
  for (auto& t : twin.uv)
    for (Vec2& p : t) p.x = -p.x;
  twin.settle();
  return twin;
}

void turn_to_smallest_rectangle(std::vector<std::array<Vec2, 3>>& uv) {
  std::vector<Vec2> points;
  for (const auto& t : uv) points.insert(points.end(), t.begin(), t.end());
  const auto before = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  // Andrew's monotone chain.
  std::vector<Vec2> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && cross2(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  if (hull.size() < 3) return;
  // The smallest rectangle has a side along an edge of the hull; thousands of edges mean a circle.
  const std::size_t step = std::max<std::size_t>(1, hull.size() / 256);
  Vec2 best(1, 0);
  double smallest = 1e300;
  for (std::size_t i = 0; i < hull.size(); i += step) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const float length = glm::length(edge);
    if (!(length > 0)) continue;
    const Vec2 x = edge / length, y(-x.y, x.x);
    Vec2 lo(1e30f), hi(-1e30f);
    for (const Vec2& p : hull) {
      const Vec2 q(glm::dot(p, x), glm::dot(p, y));
      lo = glm::min(lo, q), hi = glm::max(hi, q);
    }
    const Vec2 size = hi - lo;
    const double area = static_cast<double>(size.x) * static_cast<double>(size.y);
    if (area < smallest * (1 - 1e-6)) {
      smallest = area;
      best = size.x >= size.y ? x : y;
    }
  }
  const Vec2 y(-best.y, best.x);
  for (auto& t : uv)
    for (Vec2& p : t) p = Vec2(glm::dot(p, best), glm::dot(p, y));
}

}  // namespace sconce
