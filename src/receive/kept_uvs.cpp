// SPDX-License-Identifier: Apache-2.0
#include "receive/kept_uvs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "receive/raster.h"

namespace sconce {

namespace {

constexpr double kMostStretch = 1.5;  // L2 over a layout: beyond, it was not made for light
constexpr double kSliver = 1e-4;      // share of the area that may have no area in the set

std::array<Vec2, 3> uv_of(const World& world, uint32_t triangle, std::size_t set) {
  const auto& v = world.triangles[triangle].v;
  const auto& uv = world.texcoords[set];
  return {uv[v[0]], uv[v[1]], uv[v[2]]};
}

/// Triangles joined where their coordinates agree along a common edge.
std::vector<Patch> islands(const World& world, const MeshGraph& graph, const Patch& patch, std::size_t set) {
  std::vector<uint32_t> parent(world.size(), MeshGraph::kNone);
  for (const uint32_t t : patch) parent[t] = t;
  const auto root = [&](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const uint32_t t : patch) {
    const auto uv = uv_of(world, t, set);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t mate = graph.mates[3 * t + k];
      if (mate == MeshGraph::kNone || parent[mate / 3] == MeshGraph::kNone) continue;
      const auto other = uv_of(world, mate / 3, set);
      if (uv[k] != other[next_corner(mate % 3)] || uv[next_corner(k)] != other[mate % 3]) continue;
      const uint32_t a = root(t), b = root(mate / 3);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<Patch> result;
  std::vector<uint32_t> number(world.size(), MeshGraph::kNone);
  for (const uint32_t t : patch) {
    const uint32_t r = root(t);
    if (number[r] == MeshGraph::kNone) {
      number[r] = static_cast<uint32_t>(result.size());
      result.emplace_back();
    }
    result[number[r]].push_back(t);
  }
  return result;
}

/// Whether two islands come within two texels of each other.
bool too_close(const std::vector<Chart>& charts, Vec2 size, float texel) {
  const Vec2 extent = size / texel;
  if (!(extent.x < 16384) || !(extent.y < 16384)) return false;
  const int width = static_cast<int>(extent.x) + 3, height = static_cast<int>(extent.y) + 3;
  std::vector<uint32_t> owner(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  for (uint32_t c = 0; c < charts.size(); ++c)
    for (auto t : charts[c].uv) {
      for (Vec2& p : t) p = p / texel + Vec2(1);
      cover_texels(t, width, height, [&](int x, int y) {
        owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            c + 1;
      });
    }
  std::size_t close = 0, used = 0;
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const auto at = [&](int i, int j) {
        return owner[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(i)];
      };
      const uint32_t here = at(x, y);
      if (here == 0) continue;
      ++used;
      for (const auto& [i, j] :
           {std::pair(x + 1, y), std::pair(x, y + 1), std::pair(x + 1, y + 1), std::pair(x - 1, y + 1)})
        if (at(i, j) != 0 && at(i, j) != here) {
          ++close;
          break;
        }
    }
  return close * 100 > used;
}

/// The layout of these triangles in a set, in metres, if it can carry light.
std::vector<Chart> valid_layout(const World& world, const MeshGraph& graph, const Patch& patch,
                                std::size_t set, float texel, bool unit_square, Vec2& size) {
  std::vector<std::array<Vec2, 3>> all;
  double flat = 0, surface = 0, missing = 0;
  Vec2 lo(1e30f), hi(-1e30f);
  for (const uint32_t t : patch) {
    all.push_back(uv_of(world, t, set));
    const double area = std::abs(static_cast<double>(signed_area(all.back())));
    if (!std::isfinite(area)) return {};
    flat += area;
    surface += static_cast<double>(graph.areas[t]);
    if (area <= 0) missing += static_cast<double>(graph.areas[t]);
    for (const Vec2& p : all.back()) lo = glm::min(lo, p), hi = glm::max(hi, p);
  }
  if (!(flat > 0) || missing > kSliver * surface) return {};
  constexpr float kOutside = 1e-4f;
  if (unit_square && (lo.x < -kOutside || lo.y < -kOutside || hi.x > 1 + kOutside || hi.y > 1 + kOutside))
    return {};
  if (overlaps_itself(all)) return {};

  const auto metres = static_cast<float>(std::sqrt(surface / flat));
  const Vec2 origin = unit_square ? Vec2(0) : lo;
  size = metres * (unit_square ? Vec2(1) : hi - lo);
  std::vector<Chart> charts;
  double stretch = 0;
  for (const Patch& island : islands(world, graph, patch, set)) {
    Chart chart;
    chart.triangles = island;
    for (const uint32_t t : island) {
      auto uv = uv_of(world, t, set);
      for (Vec2& p : uv) p = metres * (glm::clamp(p, lo, hi) - origin);
      chart.uv.push_back(uv);
      chart.area += static_cast<double>(graph.areas[t]);
    }
    chart.stretch = l2_stretch(world, graph, chart);
    stretch += chart.stretch * chart.area;
    charts.push_back(std::move(chart));
  }
  if (stretch > kMostStretch * surface || too_close(charts, size, texel)) return {};
  // Twins are packed on their own, so every island also knows its extent from its own corner.
  for (Chart& chart : charts) {
    Vec2 from(1e30f), to(-1e30f);
    for (const auto& t : chart.uv)
      for (const Vec2& p : t) from = glm::min(from, p), to = glm::max(to, p);
    chart.size = to - from;
  }
  return charts;
}

}  // namespace

KeptUvs find_kept_uvs(const World& world, const MeshGraph& graph, const std::vector<float>& texels) {
  KeptUvs kept;
  const std::size_t sets = world.texcoords.size();
  if (sets == 0) return kept;
  Patch all(world.size());
  std::iota(all.begin(), all.end(), 0u);
  const float texel = *std::min_element(texels.begin(), texels.end());
  for (std::size_t i = 0; i < sets; ++i) {
    const std::size_t set = i + 1 == sets ? 0 : i + 1;
    Vec2 size;
    kept.charts = valid_layout(world, graph, all, set, texel, true, size);
    if (kept.charts.empty()) continue;
    kept.joint = true;
    kept.triangles.assign(world.size(), 1);
    kept.blocks.push_back({{}, size, 1.0f});
    for (uint32_t c = 0; c < kept.charts.size(); ++c) kept.blocks[0].charts.push_back(c);
    return kept;
  }
  kept.triangles.assign(world.size(), 0);
  for (std::size_t from = 0; from < world.size();) {
    std::size_t to = from;
    Patch patch;
    while (to < world.size() && world.instances[to] == world.instances[from])
      patch.push_back(static_cast<uint32_t>(to++));
    for (std::size_t set = 1; set < sets; ++set) {
      Vec2 size;
      std::vector<Chart> charts = valid_layout(world, graph, patch, set, texels[from], false, size);
      if (charts.empty()) continue;
      Block block{{}, size, 1.0f};
      for (Chart& chart : charts) {
        block.charts.push_back(static_cast<uint32_t>(kept.charts.size()));
        kept.charts.push_back(std::move(chart));
      }
      kept.blocks.push_back(std::move(block));
      for (const uint32_t t : patch) kept.triangles[t] = 1;
      break;
    }
    from = to;
  }
  return kept;
}

Packing pack_beside_joint(const std::vector<Block>& blocks, const std::vector<Chart>& charts,
                          const AtlasParams& params, std::vector<std::string>& warnings) {
  const float side = blocks[0].size.x;
  int page = params.page_size;
  if (page == 0) {
    page = 16;
    while (page < params.max_page && static_cast<float>(page) < params.density * side) page *= 2;
    if (static_cast<float>(page) < 0.99f * params.density * side)
      warnings.push_back("the kept layout is one page of " + std::to_string(page) +
                         " texels, which is less than the density asked for");
  }
  Packing result;
  const std::vector<Block> rest(blocks.begin() + 1, blocks.end());
  if (!rest.empty()) {
    AtlasParams others = params;
    others.page_size = page;
    others.density = static_cast<float>(page) / side;
    result = pack(rest, charts, others, warnings);
  }
  for (Placement& place : result.blocks) ++place.page;
  result.blocks.insert(result.blocks.begin(), {0, Vec2(0), static_cast<float>(page) / side});
  result.width = result.height = page;
  result.density = static_cast<float>(page) / side;
  ++result.pages;
  return result;
}

}  // namespace sconce
