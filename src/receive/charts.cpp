// SPDX-License-Identifier: Apache-2.0
#include "receive/charts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>

namespace sconce {

namespace {

constexpr float kSmooth =
    0.966f;                      // cos 15 deg: a larger step of the shading normal is an edge one wants sharp
constexpr float kCone = 0.423f;  // cos 65 deg: half angle of a patch's normals while growing
constexpr float kJoinedCrease = 0.5f;    // cos 60 deg: crease allowed when a patch is too small to show it
constexpr float kJoinedCone = 0.259f;    // cos 75 deg: between the mean normals of two joined patches
constexpr float kBoundaryWeight = 0.2f;  // boundary against normals in the order of growth
constexpr float kSmallTexels = 2.0f;     // patches below this many texels of area are joined to others
constexpr uint32_t kNone = MeshGraph::kNone;

class Grower {
 public:
  Grower(const World& world, const MeshGraph& graph, const std::vector<float>& texels,
         const std::vector<uint8_t>& kinds)
      : world_(world), graph_(graph), texels_(texels), kinds_(kinds), owner_(graph.size(), kNone) {}

  std::vector<Patch> run() {
    std::vector<uint32_t> seeds(graph_.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::sort(seeds.begin(), seeds.end(), [&](uint32_t a, uint32_t b) {
      return std::tuple(-graph_.areas[a], a) < std::tuple(-graph_.areas[b], b);
    });
    for (const uint32_t seed : seeds)
      if (owner_[seed] == kNone) grow(seed);
    join_small();
    std::vector<Patch> result;
    for (Patch& patch : patches_) {
      if (patch.empty()) continue;
      std::sort(patch.begin(), patch.end());
      result.push_back(std::move(patch));
    }
    return result;
  }

 private:
  float edge_length(uint32_t half_edge) const {
    const auto& v = world_.triangles[half_edge / 3].v;
    const uint32_t k = half_edge % 3;
    return glm::distance(world_.positions[v[k]], world_.positions[v[next_corner(k)]]);
  }

  float cost(uint32_t t, uint32_t patch, const Vec3& axis) const {
    float inner = 0, outer = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = graph_.mates[3 * t + k];
      (mate != kNone && owner_[mate / 3] == patch ? inner : outer) += edge_length(3 * t + k);
    }
    const float boundary = inner + outer > 0 ? (outer - inner) / (inner + outer) : 0.0f;
    return 1.0f - glm::dot(graph_.normals[t], axis) + kBoundaryWeight * boundary;
  }

  void grow(uint32_t seed) {
    const auto patch = static_cast<uint32_t>(patches_.size());
    patches_.emplace_back();
    Vec3 sum(0);
    using Candidate = std::pair<float, uint32_t>;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
    queue.emplace(0.0f, seed);
    while (!queue.empty()) {
      const uint32_t t = queue.top().second;
      queue.pop();
      if (owner_[t] != kNone) continue;
      if (t != seed && glm::dot(graph_.normals[t], normalize_or(sum, graph_.normals[seed])) < kCone) continue;
      owner_[t] = patch;
      patches_[patch].push_back(t);
      sum += graph_.areas[t] * graph_.normals[t];
      const Vec3 axis = normalize_or(sum, graph_.normals[seed]);
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t mate = graph_.mates[3 * t + k];
        if (mate == kNone || graph_.turn[3 * t + k] < kSmooth) continue;
        const uint32_t other = mate / 3;
        if (owner_[other] != kNone || kinds_[other] != kinds_[t]) continue;
        if (glm::dot(graph_.normals[other], axis) < kCone) continue;
        queue.emplace(cost(other, patch, axis), other);
      }
    }
    axes_.push_back(sum);
    sizes_.push_back(texel_area(patches_[patch]));
  }

  float texel_area(const Patch& patch) const {
    double area = 0;
    for (const uint32_t t : patch) area += static_cast<double>(graph_.areas[t]) / (texels_[t] * texels_[t]);
    return static_cast<float>(area);
  }

  /// The neighbour with the longest common border that the patch may join, or kNone.
  uint32_t best_neighbour(uint32_t patch) const {
    std::map<uint32_t, float> borders;
    const Vec3 axis = normalize_or(axes_[patch], Vec3(0, 1, 0));
    for (const uint32_t t : patches_[patch]) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t mate = graph_.mates[3 * t + k];
        if (mate == kNone || graph_.turn[3 * t + k] < kJoinedCrease) continue;
        const uint32_t other = owner_[mate / 3];
        if (other == patch || kinds_[mate / 3] != kinds_[t]) continue;
        if (glm::dot(axis, normalize_or(axes_[other], axis)) < kJoinedCone) continue;
        borders[other] += edge_length(3 * t + k);
      }
    }
    uint32_t best = kNone;
    float longest = 0;
    for (const auto& [other, length] : borders)
      if (length > longest) best = other, longest = length;
    return best;
  }

  void join_small() {
    using Entry = std::pair<float, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (uint32_t p = 0; p < patches_.size(); ++p)
      if (sizes_[p] < kSmallTexels) queue.emplace(sizes_[p], p);
    while (!queue.empty()) {
      const auto [size, patch] = queue.top();
      queue.pop();
      if (patches_[patch].empty() || sizes_[patch] != size) continue;
      const uint32_t into = best_neighbour(patch);
      if (into == kNone) continue;
      // Relabel the shorter list; the name that stays is the longer one's.
      uint32_t from = patch, to = into;
      if (patches_[from].size() > patches_[to].size()) std::swap(from, to);
      for (const uint32_t t : patches_[from]) owner_[t] = to;
      patches_[to].insert(patches_[to].end(), patches_[from].begin(), patches_[from].end());
      patches_[from].clear();
      axes_[to] += axes_[from];
      sizes_[to] += sizes_[from];
      if (sizes_[to] < kSmallTexels) queue.emplace(sizes_[to], to);
    }
  }

  const World& world_;
  const MeshGraph& graph_;
  const std::vector<float>& texels_;
  const std::vector<uint8_t>& kinds_;
  std::vector<uint32_t> owner_;  // per triangle: its patch
  std::vector<Patch> patches_;
  std::vector<Vec3> axes_;    // per patch: area-weighted sum of normals
  std::vector<float> sizes_;  // per patch: texels
};

uint32_t index_in(const Patch& patch, uint32_t triangle) {
  const auto it = std::lower_bound(patch.begin(), patch.end(), triangle);
  return it != patch.end() && *it == triangle ? static_cast<uint32_t>(it - patch.begin()) : kNone;
}

}  // namespace

std::vector<Patch> cut_into_patches(const World& world, const MeshGraph& graph,
                                    const std::vector<float>& texels, const std::vector<uint8_t>& kinds) {
  return Grower(world, graph, texels, kinds).run();
}

std::pair<Patch, Patch> halve(const World& world, const MeshGraph& graph, const Patch& patch) {
  const std::size_t n = patch.size();
  std::vector<Vec3> centers(n);
  Vec3 axis(0);
  Bounds bounds;
  for (std::size_t i = 0; i < n; ++i) {
    centers[i] = world.position(patch[i], Vec2(1.0f / 3));
    axis += graph.areas[patch[i]] * graph.normals[patch[i]];
    bounds.add(centers[i]);
  }
  axis = normalize_or(axis, Vec3(0));
  float least = 1;
  for (const uint32_t t : patch) least = std::min(least, glm::dot(graph.normals[t], axis));
  // A curved patch is cut across its curvature: directions weigh as much as the patch is long.
  const float weight = least < 0.9f ? 2 * bounds.diagonal() : 0.0f;
  const auto separation = [&](std::size_t i, std::size_t j) {
    return glm::distance(centers[i], centers[j]) +
           weight * glm::distance(graph.normals[patch[i]], graph.normals[patch[j]]);
  };
  const auto farthest = [&](std::size_t from) {
    std::size_t best = from == 0 ? n - 1 : 0;
    for (std::size_t i = 0; i < n; ++i)
      if (i != from && separation(from, i) > separation(from, best)) best = i;
    return best;
  };
  const std::size_t a = farthest(0), b = farthest(a);

  std::vector<uint8_t> side(n, 2);
  using Entry = std::tuple<float, uint32_t, uint8_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(0.0f, static_cast<uint32_t>(a), uint8_t{0});
  queue.emplace(0.0f, static_cast<uint32_t>(b), uint8_t{1});
  while (!queue.empty()) {
    const auto [distance, i, s] = queue.top();
    queue.pop();
    // Both seeds keep their side even where triangles coincide, so that no half is empty.
    const uint8_t own = i == a ? uint8_t{0} : i == b ? uint8_t{1} : s;
    if (side[i] != 2 || own != s) continue;
    side[i] = s;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = graph.mates[3 * patch[i] + k];
      const uint32_t j = mate == kNone ? kNone : index_in(patch, mate / 3);
      if (j == kNone || side[j] != 2) continue;
      queue.emplace(distance + separation(i, j), j, s);
    }
  }
  std::pair<Patch, Patch> halves;
  for (std::size_t i = 0; i < n; ++i) (side[i] == 1 ? halves.second : halves.first).push_back(patch[i]);
  return halves;
}

}  // namespace sconce
