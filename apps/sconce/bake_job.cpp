// SPDX-License-Identifier: Apache-2.0
#include "bake_job.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/text.h"
#include "encode/choice.h"
#include "import/import.h"
#include "receive/layout.h"
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
  hash.text(SCONCE_VERSION).text(job.solver).text(basis_row(job.params.basis).name);
  hash.value(job.params.seed)
      .value(job.params.bounces)
      .value(job.params.cloud)
      .value(job.params.cache_samples)
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

/// `f16` or `ceiling=lum:f16`: which groups, and how. @throws UsageError
struct EncodingPart {
  std::string pattern = "*", name;

  explicit EncodingPart(const std::string& text) : name(text) {
    if (const std::size_t equals = text.rfind('='); equals != std::string::npos)
      pattern = text.substr(0, equals), name = text.substr(equals + 1);
    if (name != kAutoEncoding) name = parse_encoding(name).name();
  }
};

/// The encoding of each group by `--encoding f16,ceiling=lum:f16`.
std::vector<std::string> group_encodings(const std::string& text, Basis basis, const Scene& scene) {
  std::vector<std::string> result(scene.groups.size(), "f16");
  for (const std::string& piece : split(text, ',')) {
    const EncodingPart part(piece);
    if (part.name != kAutoEncoding && basis != Basis::flat && !signed_encoding(parse_encoding(part.name)))
      throw UsageError("--encoding",
                       part.name + " cannot hold the signed basis " + std::string(basis_row(basis).name),
                       "f32, f16, srgbe8, auto");
    bool found = false;
    for (std::size_t g = 0; g < result.size(); ++g)
      if (glob_match(part.pattern, scene.groups[g].name)) {
        result[g] = part.name;
        found = true;
      }
    if (!found) {
      std::vector<std::string> names;
      for (const LightGroup& group : scene.groups) names.push_back(group.name);
      throw UsageError("--encoding", "unknown group '" + part.pattern + "'", join(names, ", "));
    }
  }
  return result;
}

std::vector<std::string> hash_inputs(const BakeJob& job, const Scene& scene, const World& world) {
  return layer_inputs(scene, world, how_hash(job) + made_with(job.params) + isa());
}

std::vector<PlaneLight> find_planes(const BakeJob& job, const World& world) {
  std::vector<PlaneLight> planes;
  for (auto& [name, plane] : import_planes(job.scene, world.bounds)) planes.push_back({name, plane, 0, {}});
  return planes;
}

/// The texels of what is kept, or new ones; ranks share what is computed from here on.
Atlas make_layout(const PreparedBake& bake, const Ranks& ranks, const Progress& progress) {
  check_agreement(join(bake.inputs, " ") + fmt::format(" {}", bake.plan.count(true)), ranks);
  if (bake.plan.count(false) == 0)
    return make_atlas(bake.scene, bake.world, bake.tracer, bake.job.atlas, progress);
  const Package& before = *bake.plan.before();
  return unpack_layout(before.layout(), bake.world.size(), before.path().string());
}

}  // namespace

bool BakeJob::may_use_blocks() const {
  const std::vector<std::string> pieces = split(encoding, ',');
  return std::any_of(pieces.begin(), pieces.end(), [](const std::string& piece) {
    const std::string name = EncodingPart(piece).name;
    return name == kAutoEncoding || parse_encoding(name).encoding->type == TexelType::bc6h;
  });
}

std::string BakeJob::to_json() const {
  const nlohmann::json json = {{"scene", scene.string()},
                               {"grouping", grouping},
                               {"solver", solver},
                               {"encoding", encoding},
                               {"max_error", max_error},
                               {"denoise", denoise},
                               {"probes", probes},
                               {"page_size", atlas.page_size},
                               {"max_page", atlas.max_page},
                               {"gutter", atlas.gutter},
                               {"density", atlas.density},
                               {"samples", params.samples},
                               {"bounces", params.bounces},
                               {"seed", params.seed},
                               {"basis", basis_row(params.basis).name},
                               {"noise", params.noise},
                               {"cloud", params.cloud},
                               {"cache_samples", params.cache_samples},
                               {"photons", params.photons},
                               {"final_gather", params.final_gather}};
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
    json.at("max_error").get_to(job.max_error);
    json.at("denoise").get_to(job.denoise);
    json.at("probes").get_to(job.probes);
    json.at("page_size").get_to(job.atlas.page_size);
    json.at("max_page").get_to(job.atlas.max_page);
    json.at("gutter").get_to(job.atlas.gutter);
    json.at("density").get_to(job.atlas.density);
    json.at("samples").get_to(job.params.samples);
    json.at("bounces").get_to(job.params.bounces);
    json.at("seed").get_to(job.params.seed);
    job.params.basis = find_basis(json.at("basis").get<std::string>());
    json.at("noise").get_to(job.params.noise);
    json.at("cloud").get_to(job.params.cloud);
    json.at("cache_samples").get_to(job.params.cache_samples);
    json.at("photons").get_to(job.params.photons);
    json.at("final_gather").get_to(job.params.final_gather);
    return job;
  } catch (const nlohmann::json::exception&) {
    throw Error(where, "the bake's description is damaged");
  }
}

void check_agreement(std::string_view seen, const Ranks& ranks) {
  if (ranks.count == 1) return;
  const std::vector<std::string> all = ranks.allgather(seen);
  for (std::size_t rank = 1; rank < all.size(); ++rank)
    if (all[rank] != all[0])
      throw Error(fmt::format("rank {}", rank),
                  "sees another scene or package or has another instruction set", "what rank 0 has");
}

PreparedBake::PreparedBake(const BakeJob& job_, const Progress& progress, const std::filesystem::path& before,
                           const Ranks& ranks)
    : job(job_),
      scene(load(job, progress)),
      world(make_world(scene)),
      inputs(hash_inputs(job, scene, world)),
      encodings(group_encodings(job.encoding, job.params.basis, scene)),
      plan(inputs, encodings, job.max_error, before),
      wanted(plan.wanted()),
      tracer(scene, world),
      lamps(scene, world),
      atlas(make_layout(*this, ranks, progress)),
      receivers(world, tracer, atlas, progress, ranks),
      planes(find_planes(job, world)),
      hash(bake_hash(job, scene, receivers)) {
  find_solver(job.solver);
  for (const std::string& warning : atlas.report.warnings) progress.warn(warning);
}

void PreparedBake::set_samples(int samples) {
  job.params.samples = samples;
  inputs = hash_inputs(job, scene, world);
}

BakeHeader PreparedBake::header() const {
  const std::size_t groups = plan.count(true), layers = groups * coefficients(job.params.basis);
  std::string records = hash;
  // Records of some groups only, on texels laid out for an earlier bake, are no part of a whole bake.
  if (groups != scene.groups.size())
    records = ContentHash()
                  .text(hash)
                  .span(std::span<const uint8_t>(wanted))
                  .text(hash_hex(pack_layout(atlas)))
                  .hex();
  return {records,      isa(), static_cast<uint32_t>(layers), receivers.size(), TexelReceivers::kTile,
          job.to_json()};
}

bool PreparedBake::up_to_date() const {
  if (plan.before() == nullptr || plan.count(true) > 0) return false;
  const auto& facts = plan.before()->manifest().facts;
  const auto found = facts.find("result_hash");
  return found != facts.end() && found->second == result_hash();
}

std::string PreparedBake::result_hash() const {
  return ContentHash()
      .text(hash)
      .text(made_with(job.params))
      .text(job.encoding)
      .value(job.max_error)
      .value(job.denoise)
      .value(job.probes)
      .hex();
}

std::unique_ptr<Solver> make_solver(const PreparedBake& bake, const std::filesystem::path& state,
                                    const Ranks& ranks, const Progress& progress) {
  // The solver keeps a view of what is wanted.
  const SolveContext context{bake.scene,  bake.world,      bake.tracer, bake.lamps,
                             &bake.atlas, &bake.receivers, bake.wanted, ranks};
  BakeParams params = bake.job.params;
  params.command = solver_command(bake.job.solver);
  params.work_folder = state;
  params.work_folder.replace_extension(".external");
  return find_solver(bake.job.solver).prepare(context, params, progress);
}

void run_bake(const PreparedBake& bake, const Solver& solver, std::span<const std::size_t> tiles,
              BakeState& state, const Progress& progress) {
  bake_tiles(solver, bake.job.params, bake.receivers, bake.wanted, tiles, state, progress);
}

void run_bake(const PreparedBake& bake, Shard shard, BakeState& state, const Progress& progress) {
  const auto solver = make_solver(bake, state.path(), {}, progress);
  run_bake(bake, *solver, missing_tiles(std::span(&state, 1), bake.job.params, shard), state, progress);
}

}  // namespace sconce::app
