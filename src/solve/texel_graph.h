// SPDX-License-Identifier: Apache-2.0
// Which texels lie beside each other on a surface: in space, not in the atlas, so that chart seams do not
// count, but walls, corners and the other side do.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "receive/atlas.h"

namespace sconce {

/// A texel as the graph sees it.
struct TexelNode {
  Vec3 position;      ///< centre of its footprint, m
  Vec3 normal;        ///< mean shading normal, unit
  Vec3 face;          ///< mean face normal, unit
  float spacing = 0;  ///< side of a whole texel there, m
  float area = 0;     ///< of its footprint, m2
};

/// Links between neighbouring texels, in both directions.
class TexelGraph {
 public:
  /// Does something stand between two points?
  using Blocked = std::function<bool(const Vec3& from, const Vec3& to)>;

  /// Links texels at most 0.8 of their spacings' sum apart, of like spacing, on one smooth surface, with
  /// nothing in between right above it. Same links at any thread count.
  TexelGraph(std::vector<TexelNode> nodes, const Blocked& blocked);

  std::size_t size() const { return nodes_.size(); }
  const TexelNode& node(std::size_t i) const { return nodes_[i]; }
  /// Ascending.
  std::span<const uint32_t> links(std::size_t i) const {
    return std::span(links_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  std::vector<TexelNode> nodes_;
  std::vector<std::size_t> first_;  ///< CSR over nodes_: range of links_
  std::vector<uint32_t> links_;
};

/// A neighbour found by a walk.
struct TexelStep {
  uint32_t node = 0;
  Vec2 offset;       ///< in the tangent plane of the walk's start, in spacings of the start
  float weight = 1;  ///< by distance, normal and area, 1 at the start
};

/// Walks from texel to texel. Keeps scratch memory of one byte count per node; one per thread.
class TexelWalk {
 public:
  explicit TexelWalk(const TexelGraph& graph) : graph_(graph), seen_(graph.size(), 0) {}

  /// Texels that links lead to within `radius` spacings of `start` and whose normals agree with its own;
  /// nearest links first, `start` itself in front, at most kMost. Valid until the next call.
  std::span<const TexelStep> around(std::size_t start, float radius);

  static constexpr std::size_t kMost = 512;

 private:
  const TexelGraph& graph_;
  std::vector<uint32_t> seen_;  ///< number of the walk that saw the node last
  uint32_t walk_ = 0;
  std::vector<TexelStep> steps_;
};

/// The graph of an atlas's receivers.
TexelGraph make_texel_graph(const TexelReceivers& receivers, const Tracer& tracer);

}  // namespace sconce
