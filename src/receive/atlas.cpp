// SPDX-License-Identifier: Apache-2.0
#include "receive/atlas.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "receive/density.h"
#include "receive/kept_uvs.h"
#include "receive/pack.h"

namespace sconce {

namespace {

void check(const AtlasParams& params) {
  if (params.page_size < 0 || params.max_page < 16)
    throw UsageError("atlas", "pages cannot be that small", "at least 16 texels");
  if (params.density < 0 || !std::isfinite(params.density))
    throw UsageError("atlas", "density is not a number of texels per metre");
  if (params.page_size == 0 && params.density == 0)
    throw UsageError("atlas", "neither page size nor density is given");
  if (params.gutter < 2) throw UsageError("atlas", "gutters are too narrow", "at least 2 texels");
}

/// Edge length of a texel per triangle, metres; where density is still open, as if half of the page were
/// used.
std::vector<float> texel_lengths(const MeshGraph& graph, const AtlasParams& params,
                                 const std::vector<uint8_t>& unseen) {
  double density = static_cast<double>(params.density);
  if (!(density > 0)) {
    double area = 1e-12;
    for (std::size_t t = 0; t < graph.size(); ++t)
      if (unseen[t] == 0) area += static_cast<double>(graph.areas[t]);
    density = std::sqrt(0.5 * params.page_size * params.page_size / area);
  }
  std::vector<float> result(graph.size());
  for (std::size_t t = 0; t < graph.size(); ++t)
    result[t] = static_cast<float>(1 / density) / (unseen[t] != 0 ? params.min_density_scale : 1.0f);
  return result;
}

std::vector<Chart> generate_charts(const World& world, const MeshGraph& graph,
                                   const std::vector<float>& texels, std::vector<uint8_t> kinds,
                                   const std::vector<uint8_t>& kept, const Progress& progress) {
  std::vector<uint32_t> wanted;
  for (std::size_t t = 0; t < world.size(); ++t)
    if (kept[t] != 0) kinds[t] = 2;
  std::vector<Patch> patches = cut_into_patches(world, graph, texels, kinds);
  std::erase_if(patches, [&](const Patch& patch) { return kept[patch.front()] != 0; });
  progress.at("unwrap", 1, 2);
  std::vector<std::vector<Chart>> found(patches.size());
  parallel_for(patches.size(), 16, [&](std::size_t i) {
    progress.check();
    parameterize(world, graph, patches[i], found[i]);
  });
  progress.at("unwrap", 2, 2);
  std::vector<Chart> charts;
  for (auto& list : found)
    for (Chart& chart : list) charts.push_back(std::move(chart));
  return charts;
}

void report_charts(const std::vector<Chart>& charts, AtlasReport& report) {
  report.charts = charts.size();
  double sum = 0, area = 0, most = 1;
  for (const Chart& chart : charts) {
    sum += chart.stretch * chart.area;
    area += chart.area;
    most = std::max(most, chart.stretch);
    if (chart.back) report.twins += chart.triangles.size();
  }
  report.stretch_mean = area > 0 ? sum / area : 1;
  report.stretch_max = most;
}

}  // namespace

Atlas make_atlas(const Scene& scene, const World& world, const Tracer& tracer, const AtlasParams& params,
                 const Progress& progress) {
  check(params);
  if (world.size() == 0) throw Error(scene.name, "the scene has nothing to light");
  const MeshGraph graph = make_mesh_graph(world);
  const Visibility seen = probe_visibility(scene, world, graph, tracer, params.seed, progress);
  const std::vector<uint8_t> unseen = unseen_triangles(seen, graph);

  std::vector<Chart> charts;
  std::vector<Block> blocks;
  KeptUvs kept;
  const std::vector<float> texels = texel_lengths(graph, params, unseen);
  if (params.keep_uvs) kept = find_kept_uvs(world, graph, texels);
  kept.triangles.resize(world.size(), 0);
  charts = std::move(kept.charts);
  blocks = std::move(kept.blocks);
  for (Chart& chart : generate_charts(world, graph, texels, unseen, kept.triangles, progress)) {
    blocks.push_back({{static_cast<uint32_t>(charts.size())}, chart.size, 1.0f});
    charts.push_back(std::move(chart));
  }

  Atlas atlas;
  atlas.reached_back.assign(world.size(), 0);
  const std::size_t fronts = charts.size();
  for (std::size_t c = 0; c < fronts; ++c) {
    if (!back_is_reached(seen, graph, charts[c].triangles)) continue;
    for (const uint32_t t : charts[c].triangles) atlas.reached_back[t] = 1;
    if (!scene[world.materials[charts[c].triangles.front()]].double_sided) continue;
    blocks.push_back({{static_cast<uint32_t>(charts.size())}, charts[c].size, 1.0f});
    charts.push_back(make_twin(charts[c]));
  }
  for (const Chart& chart : charts)
    atlas.seen_charts.push_back(is_reached(seen, chart.triangles, chart.back) ? 1 : 0);
  for (Block& block : blocks) {
    float scale = 0;
    for (const uint32_t c : block.charts) {
      const Instance& instance = scene[world.instances[charts[c].triangles.front()]];
      const float wanted = instance.lightmap_scale > 0 ? instance.lightmap_scale : 1.0f;
      scale = std::max(scale, wanted * density_scale(seen, graph, charts[c].triangles, charts[c].back,
                                                     params.min_density_scale));
    }
    block.scale = scale;
  }

  progress.at("pack", 0, 1);
  const Packing packing = kept.joint ? pack_beside_joint(blocks, charts, params, atlas.report.warnings)
                                     : pack(blocks, charts, params, atlas.report.warnings);
  progress.at("pack", 1, 1);
  atlas.width = packing.width;
  atlas.height = packing.height;
  atlas.pages = packing.pages;
  atlas.density = packing.density;
  atlas.front.resize(world.size());
  atlas.back.resize(world.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Placement& place = packing.blocks[b];
    for (const uint32_t c : blocks[b].charts) {
      const Chart& chart = charts[c];
      const std::vector<double> importance = importances(seen, graph, chart.triangles, chart.back);
      for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
        TexelTriangle& side = (chart.back ? atlas.back : atlas.front)[chart.triangles[i]];
        side.page = place.page;
        side.chart = c;
        side.importance = importance_code(importance[i]);
        for (std::size_t k = 0; k < 3; ++k)
          side.uv[k] = place.origin + chart.uv[i][k] * place.texels_per_metre;
      }
    }
  }
  report_charts(charts, atlas.report);
  atlas.report.kept_uvs =
      !kept.triangles.empty() && std::ranges::any_of(kept.triangles, [](uint8_t k) { return k != 0; });
  for (const std::string& line : atlas.report.warnings) progress.warn(line);
  return atlas;
}

}  // namespace sconce
