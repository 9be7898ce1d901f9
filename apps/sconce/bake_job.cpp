// SPDX-License-Identifier: Apache-2.0
#include "bake_job.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/text.h"
#include "encode/encoding.h"
#include "import/import.h"
#include "receive/layout.h"
#include "solve/denoise.h"
#include "solve/inputs.h"

namespace sconce::app {

namespace {

Scene load(const BakeJob& job, const Progress& progress) {
  progress.at("read scene", 0, 1);
  Scene scene = import_scene(job.scene, progress);
  assign_groups(scene, parse_grouping(job.grouping));
  if (scene.groups.empty())
    throw Error(job.scene.string(), "the scene has no lights",
                "emissive materials, KHR_lights_punctual, or [[light]] and [sky] in " +
                    job.scene.stem().string() + ".toml");
  return scene;
}

/// Of all options that a bake's records depend on but those in made_with().
std::string how_hash(const BakeJob& job) {
  ContentHash hash;
  hash.text(SCONCE_VERSION).text(job.solver).text("flat");
  hash.value(job.params.seed)
      .value(job.params.bounces)
      .value(job.params.cloud)
      .value(job.params.photons)
      .value(job.params.final_gather);
  hash.value(job.atlas.page_size).value(job.atlas.max_page).value(job.atlas.density).value(job.atlas.gutter);
  hash.value(job.atlas.min_density_scale).value(job.atlas.keep_uvs).value(job.atlas.seed);
  return hash.hex();
}

std::string bake_hash(const BakeJob& job, const Scene& scene, const TexelReceivers& receivers) {
  ContentHash hash;
  hash.text(how_hash(job)).text(hash_file(job.scene)).text(job.grouping);
  for (const std::filesystem::path& file : scene_files(job.scene)) hash.text(hash_file(file));
  for (const LightGroup& group : scene.groups) hash.text(group.name);
  hash.value(receivers.size());
  return hash.hex();
}

/// The encoding of each group by `--encoding f16,ceiling=f32`.
std::vector<std::string> group_encodings(const std::string& text, const Scene& scene) {
  std::vector<std::string> result(scene.groups.size(), "f16");
  for (const std::string& part : split(text, ',')) {
    const std::size_t equals = part.rfind('=');
    const std::string pattern = equals == std::string::npos ? "*" : part.substr(0, equals);
    const std::string name(find_encoding(equals == std::string::npos ? part : part.substr(equals + 1)).name);
    bool found = false;
    for (std::size_t g = 0; g < result.size(); ++g)
      if (glob_match(pattern, scene.groups[g].name)) {
        result[g] = name;
        found = true;
      }
    if (!found) {
      std::vector<std::string> names;
      for (const LightGroup& group : scene.groups) names.push_back(group.name);
      throw UsageError("--encoding", "unknown group '" + pattern + "'", join(names, ", "));
    }
  }
  return result;
}

/// The texels of what is kept, or new ones.
Atlas make_layout(const PreparedBake& bake, const Progress& progress) {
  if (bake.plan.count(false) == 0)
    return make_atlas(bake.scene, bake.world, bake.tracer, bake.job.atlas, progress);
  const Package& before = *bake.plan.before();
  return unpack_layout(before.layout(), bake.world.size(), before.path().string());
}

/// All groups' values as images, empty for kept groups. @return means and noise; the pages are moved into
/// `layers`
std::vector<Layer> assemble(const PreparedBake& bake, std::span<const std::vector<GroupValue>> values,
                            std::span<const float> areas, std::vector<std::vector<Image>>& layers,
                            std::vector<Image>& noise, const Progress& progress) {
  std::vector<std::string> channels;
  for (const LightGroup& group : bake.scene.groups) channels.push_back(group.name);
  for (int p = 0; p < bake.atlas.pages; ++p)
    noise.push_back(Image(bake.atlas.width, bake.atlas.height, channels));
  std::vector<Layer> result;
  std::vector<Image> old_noise;
  for (int p = 0; p < bake.atlas.pages && bake.plan.count(false) > 0; ++p)
    old_noise.push_back(bake.plan.before()->noise(p));
  for (std::size_t g = 0; g < values.size(); ++g) {
    progress.at("layers", g, values.size());
    progress.check();
    if (const auto kept = bake.plan.kept(g)) {
      const GroupInfo& before = bake.plan.before()->manifest().groups[*kept];
      for (std::size_t p = 0; p < old_noise.size(); ++p)
        for (std::size_t i = 0; i < old_noise[p].pixels(); ++i)
          noise[p].data[i * channels.size() + g] = old_noise[p].data[i * old_noise[p].stride() + *kept];
      result.emplace_back();
      result.back().mean_lux = before.mean_lux;
      result.back().relative_noise = before.noise;
      layers.emplace_back();
      continue;
    }
    Layer& layer = result.emplace_back(assemble_layer(values[g], bake.atlas, bake.receivers, areas));
    for (std::size_t p = 0; p < layer.noise.size(); ++p)
      for (std::size_t i = 0; i < layer.noise[p].pixels(); ++i)
        noise[p].data[i * channels.size() + g] = layer.noise[p].data[i];
    layer.noise.clear();
    layers.push_back(std::move(layer.pages));
  }
  return result;
}

}  // namespace

std::string BakeJob::to_json() const {
  const nlohmann::json json = {
      {"scene", scene.string()},    {"grouping", grouping},      {"solver", solver},
      {"encoding", encoding},       {"denoise", denoise},        {"page_size", atlas.page_size},
      {"max_page", atlas.max_page}, {"density", atlas.density},  {"samples", params.samples},
      {"bounces", params.bounces},  {"seed", params.seed},       {"noise", params.noise},
      {"cloud", params.cloud},      {"photons", params.photons}, {"final_gather", params.final_gather}};
  return json.dump();
}

BakeJob BakeJob::from_json(const std::string& text, const std::string& where) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    BakeJob job;
    job.scene = json.at("scene").get<std::string>();
    json.at("grouping").get_to(job.grouping);
    json.at("solver").get_to(job.solver);
    json.at("encoding").get_to(job.encoding);
    json.at("denoise").get_to(job.denoise);
    json.at("page_size").get_to(job.atlas.page_size);
    json.at("max_page").get_to(job.atlas.max_page);
    json.at("density").get_to(job.atlas.density);
    json.at("samples").get_to(job.params.samples);
    json.at("bounces").get_to(job.params.bounces);
    json.at("seed").get_to(job.params.seed);
    json.at("noise").get_to(job.params.noise);
    json.at("cloud").get_to(job.params.cloud);
    json.at("photons").get_to(job.params.photons);
    json.at("final_gather").get_to(job.params.final_gather);
    return job;
  } catch (const nlohmann::json::exception&) {
    throw Error(where, "the bake's description is damaged");
  }
}

PreparedBake::PreparedBake(const BakeJob& job_, const Progress& progress, const std::filesystem::path& before)
    : job(job_),
      scene(load(job, progress)),
      world(make_world(scene)),
      inputs(layer_inputs(scene, world,
                          how_hash(job) + made_with(job.params) + isa() + (job.denoise ? "denoised" : ""))),
      plan(inputs, group_encodings(job.encoding, scene), before, job.denoise),
      tracer(scene, world),
      lamps(scene, world),
      atlas(make_layout(*this, progress)),
      receivers(world, tracer, atlas, progress),
      hash(bake_hash(job, scene, receivers)) {
  find_solver(job.solver);
  for (const std::string& warning : atlas.report.warnings) progress.warn(warning);
}

BakeHeader PreparedBake::header() const {
  // Records of some groups only, on texels laid out for an earlier bake, are no part of a whole bake.
  ContentHash partial;
  partial.text(hash).span(std::span<const uint8_t>(plan.wanted())).text(hash_hex(pack_layout(atlas)));
  const std::size_t groups = plan.count(true);
  return {groups == scene.groups.size() ? hash : partial.hex(),
          isa(),
          static_cast<uint32_t>(groups),
          receivers.size(),
          TexelReceivers::kTile,
          job.to_json()};
}

bool PreparedBake::up_to_date() const {
  if (plan.before() == nullptr) return false;
  const auto& facts = plan.before()->manifest().facts;
  const auto found = facts.find("result_hash");
  return found != facts.end() && found->second == result_hash();
}

std::string PreparedBake::result_hash() const {
  return ContentHash().text(hash).text(made_with(job.params)).text(job.encoding).value(job.denoise).hex();
}

void run_bake(const PreparedBake& bake, std::span<const std::size_t> tiles, BakeState& state,
              const Ranks& ranks, const Progress& progress) {
  const std::vector<uint8_t> wanted = bake.plan.wanted();
  const SolveContext context{bake.scene,  bake.world,      bake.tracer, bake.lamps,
                             &bake.atlas, &bake.receivers, wanted,      ranks};
  BakeParams params = bake.job.params;
  params.command = solver_command(bake.job.solver);
  params.work_folder = state.path();
  params.work_folder.replace_extension(".external");
  const auto solver = find_solver(bake.job.solver).prepare(context, params, progress);
  bake_tiles(*solver, bake.job.params, bake.receivers, wanted, tiles, state, progress);
}

void run_bake(const PreparedBake& bake, Shard shard, BakeState& state, const Progress& progress) {
  run_bake(bake, missing_tiles(std::span(&state, 1), bake.job.params, shard), state, {}, progress);
}

Manifest write_result(const PreparedBake& bake, std::span<BakeState> states,
                      const std::filesystem::path& output, const std::map<std::string, Provenance>& options,
                      const Progress& progress) {
  const BakePlan& plan = bake.plan;
  const std::vector<std::size_t> missing =
      states.empty() ? std::vector<std::size_t>{} : missing_tiles(states, bake.job.params);
  if (!missing.empty() || (states.empty() && plan.count(true) > 0))
    throw Error(output.string(),
                fmt::format("{} of {} tiles are missing, the first is {}", missing.size(),
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
  manifest.instance_pages = baked.pages;
  for (const Id<Instance> twin : baked.twins)
    manifest.instance_twins.push_back(twin.valid() ? static_cast<int>(twin.value) : -1);
  manifest.options = options;
  manifest.facts = {{"solver", bake.job.solver},
                    {"samples", fmt::format("{}", bake.job.params.samples)},
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
  contents.encodings = group_encodings(bake.job.encoding, bake.scene);

  std::vector<std::vector<GroupValue>> values;
  contents.kept.resize(bake.scene.groups.size());
  uint32_t solved = 0;
  for (uint32_t g = 0; g < bake.scene.groups.size(); ++g) {
    if (const auto kept = plan.kept(g)) contents.kept[g] = {plan.before(), *kept};
    values.push_back(plan.kept(g) ? std::vector<GroupValue>{}
                                  : collect_values(states, bake.job.params, solved++));
  }
  if (bake.job.denoise) {
    assemble(bake, values, areas, contents.raw, contents.raw_noise, progress);
    values = denoise(make_texel_graph(atlas, bake.receivers, bake.tracer), values, progress);
  }
  const std::vector<Layer> layers = assemble(bake, values, areas, contents.layers, contents.noise, progress);
  const std::vector<GroupFlux> fluxes = group_flux(bake.scene, bake.lamps);
  for (uint32_t g = 0; g < bake.scene.groups.size(); ++g) {
    const GroupFlux& flux = fluxes[g];
    manifest.groups.push_back({bake.scene.groups[g].name, flux.lumens, flux.color, flux.spread, flux.infinite,
                               layers[g].mean_lux, layers[g].relative_noise, flux.lamps, bake.inputs[g]});
  }
  contents.layout = pack_layout(atlas);
  contents.scene = std::move(baked.scene);
  progress.at("write", 0, 1);
  write_package(output, std::move(contents));
  return Package::open(output, false).manifest();
}

}  // namespace sconce::app
