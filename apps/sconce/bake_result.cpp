// SPDX-License-Identifier: Apache-2.0
// From the solver's records and what is kept to a package.
#include <fmt/format.h>

#include "bake_job.h"
#include "core/parallel.h"
#include "receive/layout.h"
#include "solve/denoise.h"

namespace sconce::app {

namespace {

/// The solver's own values at all receivers, [coefficient * groups + group]: from the states, or from the
/// package that they are kept from.
std::vector<std::vector<GroupValue>> own_values(const PreparedBake& bake, std::span<const BakeState> states,
                                                const Progress& progress) {
  const Package* before = bake.plan.before();
  const std::size_t page_texels =
      static_cast<std::size_t>(bake.atlas.width) * static_cast<std::size_t>(bake.atlas.height);
  std::vector<Image> noise;
  for (int p = 0; p < bake.atlas.pages && bake.plan.count(false) > 0; ++p) noise.push_back(before->noise(p));
  std::vector<std::vector<GroupValue>> values;
  uint32_t solved = 0;
  const std::size_t groups = bake.scene.groups.size();
  for (std::size_t l = 0; l < groups * coefficients(bake.job.params.basis); ++l) {
    progress.check();
    const std::size_t c = l / groups;
    const auto kept = bake.plan.kept(l % groups);
    if (!kept) {
      values.push_back(collect_values(states, bake.job.params, solved++));
      continue;
    }
    std::vector<Image> pages;
    for (int p = 0; p < bake.atlas.pages; ++p) pages.push_back(before->layer(*kept, p, c));
    std::vector<GroupValue>& all = values.emplace_back(bake.receivers.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t page = bake.receivers.texel(i) / page_texels,
                        at = bake.receivers.texel(i) % page_texels;
      const float* rgb = &pages[page].data[3 * at];
      all[i].illuminance = Rgb(rgb[0], rgb[1], rgb[2]);
      // Of further coefficients no errors are kept; nothing reads them.
      if (c == 0)
        all[i].error = noise[page].data[at * noise[page].stride() + *kept] * luminance(all[i].illuminance);
    }
  }
  return values;
}

/// All values as images. @return means and noise; the pages are moved into `layers`
std::vector<Layer> assemble(const PreparedBake& bake, std::span<const std::vector<GroupValue>> values,
                            std::span<const float> areas, const Seams* seams,
                            std::vector<std::vector<Image>>& layers, std::vector<Image>& noise,
                            const Progress& progress) {
  std::vector<std::string> channels;
  for (const LightGroup& group : bake.scene.groups) channels.push_back(group.name);
  for (int p = 0; p < bake.atlas.pages; ++p)
    noise.push_back(Image(bake.atlas.width, bake.atlas.height, channels));
  std::vector<Layer> result;
  for (std::size_t g = 0; g < values.size(); ++g) {
    progress.at("layers", g, values.size());
    progress.check();
    Layer& layer = result.emplace_back(assemble_layer(values[g], bake.atlas, bake.receivers, areas, seams));
    for (std::size_t p = 0; p < layer.noise.size() && g < channels.size(); ++p)
      for (std::size_t i = 0; i < layer.noise[p].pixels(); ++i)
        noise[p].data[i * channels.size() + g] = layer.noise[p].data[i];
    layer.noise.clear();
    layers.push_back(std::move(layer.pages));
  }
  return result;
}

/// Planes and probes, always of all groups: they are few.
std::map<std::string, Image> points(const PreparedBake& bake, std::span<const GroupInfo> groups,
                                    const Progress& progress) {
  const SolveContext context{bake.scene, bake.world, bake.tracer, bake.lamps};
  std::vector<PlaneLight> planes = bake.planes;
  for (PlaneLight& plane : planes) bake_plane(plane, context, bake.job.params, progress);
  std::optional<ProbeGrid> probes;
  if (bake.job.probes > 0)
    probes = bake_probes(static_cast<float>(bake.job.probes), context, bake.job.params, progress);
  return print_points(planes, probes ? &*probes : nullptr, groups);
}

}  // namespace

Manifest write_result(const PreparedBake& bake, std::span<BakeState> states,
                      const std::filesystem::path& output, const std::map<std::string, Provenance>& options,
                      const Progress& progress) {
  const std::vector<std::size_t> missing =
      states.empty() ? std::vector<std::size_t>{} : missing_tiles(states, bake.job.params);
  if (!missing.empty() || (states.empty() && bake.plan.count(true) > 0))
    throw Error(output.string(),
                missing.empty() ? "all tiles are missing"
                                : fmt::format("{} of {} tiles are missing, the first is {}", missing.size(),
                                              states.front().tiles(), missing.front()),
                "all shards of one bake");
  const Atlas& atlas = bake.atlas;
  const std::size_t page_texels =
      static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height);

  PackageContents contents;
  for (int p = 0; p < atlas.pages; ++p)
    contents.receivers.push_back(
        Image(atlas.width, atlas.height, {"albedo.R", "albedo.G", "albedo.B", "weight"}));
  std::vector<float> areas(bake.receivers.size());
  progress.at("receivers", 0, 1);
  parallel_for(bake.receivers.size(), 256, [&](std::size_t i) {
    areas[i] = bake.receivers.footprint(i).area;
    const Rgb albedo = bake.receivers.albedo(bake.scene, i);
    const uint32_t texel = bake.receivers.texel(i);
    float* pixel = &contents.receivers[texel / page_texels].data[4 * (texel % page_texels)];
    pixel[0] = albedo.r, pixel[1] = albedo.g, pixel[2] = albedo.b;
    pixel[3] = areas[i] * bake.receivers.importance(i);
  });

  BakedScene baked = make_baked_scene(bake.scene, bake.world, atlas);
  Manifest& manifest = contents.manifest;
  manifest.generator = "sconce " SCONCE_VERSION;
  manifest.scene_name = bake.scene.name;
  manifest.scene_hash = bake.hash;
  manifest.width = atlas.width, manifest.height = atlas.height, manifest.pages = atlas.pages;
  manifest.density = static_cast<double>(atlas.density);
  manifest.lightmap_set = baked.lightmap_set;
  manifest.basis = bake.job.params.basis;
  manifest.instance_pages = baked.pages;
  for (const Id<Instance> twin : baked.twins)
    manifest.instance_twins.push_back(twin.valid() ? static_cast<int>(twin.value) : -1);
  manifest.options = options;
  manifest.facts = {{"solver", bake.job.solver},
                    {"samples", bake.job.params.noise > 0
                                    ? fmt::format("up to {}, until {:.3g} % noise", bake.job.params.samples,
                                                  100 * bake.job.params.noise)
                                    : fmt::format("{}", bake.job.params.samples)},
                    {"denoised", bake.job.denoise ? "yes" : "no"},
                    {"isa", isa()},
                    {"seed", fmt::format("{}", bake.job.params.seed)},
                    {"result_hash", bake.result_hash()},
                    {"receivers", fmt::format("{}", bake.receivers.size())},
                    {"charts", fmt::format("{}", atlas.report.charts)},
                    {"utilisation", fmt::format("{:.3f}", atlas.report.utilisation)},
                    {"invalid", fmt::format("{}", atlas.report.invalid)},
                    {"stretch", fmt::format("mean {:.3f}, max {:.3f}", atlas.report.stretch_mean,
                                            atlas.report.stretch_max)}};
  contents.encodings = bake.encodings;
  contents.max_error = bake.job.max_error;

  std::vector<std::vector<GroupValue>> values = own_values(bake, states, progress);
  if (bake.job.denoise) {
    assemble(bake, values, areas, nullptr, contents.raw, contents.raw_noise, progress);
    values = denoise(make_texel_graph(bake.receivers, bake.tracer), values, progress,
                     bake.scene.groups.size());
  }
  const Seams seams(bake.world, bake.tracer, atlas);
  const std::vector<Layer> layers =
      assemble(bake, values, areas, &seams, contents.layers, contents.noise, progress);
  const std::vector<GroupFlux> fluxes = group_flux(bake.scene, bake.lamps);
  contents.kept.resize(bake.scene.groups.size());
  for (uint32_t g = 0; g < bake.scene.groups.size(); ++g) {
    const GroupFlux& flux = fluxes[g];
    GroupInfo info{
        bake.scene.groups[g].name, flux.lumens, flux.color,    flux.spread, flux.infinite, layers[g].mean_lux,
        layers[g].relative_noise,  flux.lamps,  bake.inputs[g]};
    if (const auto kept = bake.plan.kept(g)) {
      const Manifest& before = bake.plan.before()->manifest();
      contents.kept[g] = {bake.plan.before(), *kept};
      if (!bake.job.denoise && before.raw.empty())
        info.mean_lux = before.groups[*kept].mean_lux, info.noise = before.groups[*kept].noise;
    }
    manifest.groups.push_back(std::move(info));
  }
  const std::map<std::string, Image> point_files = points(bake, manifest.groups, progress);
  contents.layout = pack_layout(atlas);
  contents.scene = std::move(baked.scene);
  progress.at("write", 0, 1);
  write_package(output, std::move(contents), point_files);
  return Package::open(output, false).manifest();
}

}  // namespace sconce::app
