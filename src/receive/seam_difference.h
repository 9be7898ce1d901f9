// SPDX-License-Identifier: Apache-2.0
// How differently a lightmap is seen from both sides of its smooth seams. For tests and benchmarks.
#pragma once

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "receive/atlas.h"
#include "receive/mesh_graph.h"
#include "receive/parameterize.h"

namespace sconce {

/// As hardware looks a place up, in texels. @return the first channel
inline float look_up(const Image& image, Vec2 at) {
  const Vec2 low = glm::floor(at - 0.5f), part = at - 0.5f - low;
  float sum = 0;
  for (int c = 0; c < 4; ++c) {
    const int x = std::clamp(static_cast<int>(low.x) + (c & 1), 0, image.width - 1),
              y = std::clamp(static_cast<int>(low.y) + (c >> 1), 0, image.height - 1);
    sum += ((c & 1) != 0 ? part.x : 1 - part.x) * ((c >> 1) != 0 ? part.y : 1 - part.y) * image.at(x, y)[0];
  }
  return sum;
}

struct SeamDifference {
  std::vector<double> places;  ///< absolute, ascending
  double rms = 0, largest = 0;
  double at(double share) const {
    return places.empty() ? 0
                          : places[static_cast<std::size_t>(share * static_cast<double>(places.size() - 1))];
  }
};

/// Does something stand on the middle of a half-edge, half a texel above it?
inline bool stands_on(const World& world, const Tracer& tracer, uint32_t half_edge, float texels) {
  const auto& v = world.triangles[half_edge / 3].v;
  const Vec3 a = world.positions[v[half_edge % 3]], b = world.positions[v[next_corner(half_edge % 3)]],
             normal = world.face_normals[half_edge / 3],
             aside = normalize_or(glm::cross(normal, b - a), normal);
  const float half = 0.5f * glm::length(b - a) / texels;
  return tracer.occluded({0.5f * (a + b) + half * (normal + aside), -aside, 2 * half});
}

/// Texels across a chart: its area by its longer side.
inline std::vector<float> chart_widths(const Atlas& atlas) {
  struct Extent {
    Bounds box;
    float area = 0;
  };
  std::vector<Extent> charts;
  for (const auto* sides : {&atlas.front, &atlas.back})
    for (const TexelTriangle& t : *sides) {
      if (t.page < 0) continue;
      if (t.chart >= charts.size()) charts.resize(t.chart + 1);
      charts[t.chart].area += std::abs(signed_area(t.uv));
      for (const Vec2& p : t.uv) charts[t.chart].box.add(Vec3(p, 0));
    }
  std::vector<float> out;
  for (const Extent& c : charts) {
    const Vec3 size = c.box.empty() ? Vec3(0) : c.box.hi - c.box.lo;
    out.push_back(c.area > 0 ? c.area / std::max(size.x, size.y) : 0);
  }
  return out;
}

/// Between the first channels on both sides, four times per texel along all edges of fronts whose texels part
/// though the surface goes on smoothly. @param tracer  leaves out edges that something stands on; may be null
/// @param width  leaves out edges of charts that are fewer texels across
inline SeamDifference across_seams(const World& world, const Atlas& atlas, const std::vector<Image>& pages,
                                   const Tracer* tracer = nullptr, float width = 0) {
  const MeshGraph graph = make_mesh_graph(world);
  const std::vector<float> widths = chart_widths(atlas);
  SeamDifference found;
  float due = 0.125f;  // texels to the next place: short edges have few
  for (uint32_t h = 0; h < graph.mates.size(); ++h) {
    const uint32_t mate = graph.mates[h];
    if (mate == MeshGraph::kNone || mate < h || graph.turn[h] < 0.999f) continue;
    const TexelTriangle &a = atlas.front[h / 3], &b = atlas.front[mate / 3];
    if (a.page < 0 || b.page < 0 || std::min(widths[a.chart], widths[b.chart]) < width) continue;
    const Vec2 a0 = a.uv[h % 3], a1 = a.uv[next_corner(h % 3)], b0 = b.uv[next_corner(mate % 3)],
               b1 = b.uv[mate % 3];
    if (a.page == b.page && glm::distance(a0, b0) < 1e-3f && glm::distance(a1, b1) < 1e-3f) continue;
    const float length = glm::distance(a0, a1);
    if (tracer != nullptr && stands_on(world, *tracer, h, length)) continue;
    for (; due < length; due += 0.25f) {
      const float t = due / length;
      const float here = look_up(pages[static_cast<std::size_t>(a.page)], glm::mix(a0, a1, t)),
                  there = look_up(pages[static_cast<std::size_t>(b.page)], glm::mix(b0, b1, t));
      found.places.push_back(std::abs(static_cast<double>(here - there)));
    }
    due -= length;
  }
  std::sort(found.places.begin(), found.places.end());
  for (const double d : found.places) found.rms += d * d;
  found.rms = std::sqrt(found.rms / static_cast<double>(std::max<std::size_t>(found.places.size(), 1)));
  found.largest = found.at(1);
  return found;
}

}  // namespace sconce
