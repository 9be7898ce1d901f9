// SPDX-License-Identifier: Apache-2.0
#include "solve/texel_graph.h"

#include <algorithm>
#include <nanoflann.hpp>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr float kReach = 0.8f;  // longest link, in the sum of both spacings: diagonals are 0.71
constexpr float kCoarser = 4;   // how much wider than another a texel may be to be linked to it
constexpr float kFlat = 0.01f;  // how far a link may leave the plane, as a sine, where faces are parallel
constexpr float kLinkCosine = 0.8f;  // between the normals of linked texels
constexpr float kWalkCosine = 0.9f;  // between the normals of a walk's start and end
constexpr float kLift = 0.1f;        // links are looked along so far above the surface, in their length

/// What nanoflann sees of the nodes.
struct Points {
  const std::vector<TexelNode>& nodes;
  std::size_t kdtree_get_point_count() const { return nodes.size(); }
  float kdtree_get_pt(uint32_t i, std::size_t axis) const {
    return nodes[i].position[static_cast<int>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, uint32_t>;

bool linked(const TexelNode& a, const TexelNode& b, const TexelGraph::Blocked& blocked) {
  const Vec3 d = b.position - a.position;
  const float length = glm::length(d);
  if (length > kReach * (a.spacing + b.spacing)) return false;
  if (glm::dot(a.normal, b.normal) < kLinkCosine) return false;
  // Over a bend one end is off the other's plane by at most the sine of the angle between the planes.
  const float leave = length * (kFlat + glm::length(glm::cross(a.face, b.face)));
  if (std::abs(glm::dot(d, a.face)) > leave || std::abs(glm::dot(d, b.face)) > leave) return false;
  const float lift = kLift * length;
  return !blocked(a.position + lift * a.normal, b.position + lift * b.normal);
}

}  // namespace

TexelGraph::TexelGraph(std::vector<TexelNode> nodes, const Blocked& blocked) : nodes_(std::move(nodes)) {
  first_.assign(size() + 1, 0);
  if (nodes_.empty()) return;
  const Points points{nodes_};
  const Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  // The finer of two texels looks for the other: a coarse one would look through all of a crowded corner.
  std::vector<std::vector<uint32_t>> found(size());
  parallel_for(size(), 256, [&](std::size_t i) {
    const TexelNode& node = nodes_[i];
    const float reach = kReach * (1 + kCoarser) * node.spacing;
    std::vector<std::pair<uint32_t, float>> matches;
    tree.radiusSearch(&node.position.x, reach * reach, matches, nanoflann::SearchParams());
    for (const auto& [j, squared] : matches) {
      const float other = nodes_[j].spacing;
      if (other < node.spacing || other > kCoarser * node.spacing) continue;
      if (j == i || (other == node.spacing && j < i)) continue;
      if (linked(node, nodes_[j], blocked)) found[i].push_back(j);
    }
    std::sort(found[i].begin(), found[i].end());
  });
  for (std::size_t i = 0; i < size(); ++i) {
    first_[i + 1] += found[i].size();
    for (const uint32_t j : found[i]) ++first_[j + 1];
  }
  for (std::size_t i = 0; i < size(); ++i) first_[i + 1] += first_[i];
  links_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < size(); ++i)
    for (const uint32_t j : found[i]) {
      links_[next[i]++] = j;
      links_[next[j]++] = static_cast<uint32_t>(i);
    }
  parallel_for(size(), 1024, [&](std::size_t i) {
    std::sort(links_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
              links_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]));
  });
}

std::span<const TexelStep> TexelWalk::around(std::size_t start, float radius) {
  const TexelNode& from = graph_.node(start);
  const Frame frame(from.normal);
  const float scale = 1 / from.spacing;
  ++walk_;
  seen_[start] = walk_;
  steps_.assign(1, {static_cast<uint32_t>(start), Vec2(0), 1});
  for (std::size_t k = 0; k < steps_.size() && steps_.size() < kMost; ++k)
    for (const uint32_t j : graph_.links(steps_[k].node)) {
      if (seen_[j] == walk_) continue;
      seen_[j] = walk_;
      const TexelNode& to = graph_.node(j);
      const Vec3 d = (to.position - from.position) * scale;
      const float squared = glm::dot(d, d) / (radius * radius);
      const float cosine = glm::dot(from.normal, to.normal);
      if (squared > 1 || cosine <= kWalkCosine) continue;
      const float fall = 1 - squared;
      const float part = std::min(1.0f, to.area * scale * scale);  // slivers at a chart's edge count less
      const float weight = part * fall * fall * std::min(1.0f, (cosine - kWalkCosine) / (1 - kWalkCosine));
      if (weight > 0) steps_.push_back({j, Vec2(glm::dot(d, frame.x), glm::dot(d, frame.y)), weight});
    }
  return steps_;
}

TexelGraph make_texel_graph(const TexelReceivers& receivers, const Tracer& tracer) {
  std::vector<TexelNode> nodes(receivers.size());
  parallel_for(receivers.size(), 256, [&](std::size_t i) {
    const Footprint footprint = receivers.footprint(i);
    Vec3 position(0), normal(0), face(0);
    float before = 0;
    for (const FootprintPiece& piece : footprint.pieces) {
      const float share = piece.cumulative - before;
      before = piece.cumulative;
      position += share / 3 * (piece.p0 + piece.p1 + piece.p2);
      normal += share / 3 * (piece.n0 + piece.n1 + piece.n2);
      face += share * piece.geometric_normal;
    }
    const Vec3 first = footprint.pieces.front().geometric_normal;
    nodes[i] = {position, normalize_or(normal, first), normalize_or(face, first), receivers.spacing(i),
                footprint.area};
  });
  return TexelGraph(std::move(nodes), [&](const Vec3& from, const Vec3& to) {
    const float length = glm::distance(from, to);
    return length > 0 && tracer.occluded({from, (to - from) / length, length});
  });
}

}  // namespace sconce
