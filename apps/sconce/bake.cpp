// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app.h"
#include "bake_job.h"
#include "core/parallel.h"
#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Quality {
  const char* name;
  int samples;
};
constexpr Quality kQualities[] = {{"draft", 32}, {"normal", 128}, {"final", 1024}};

int samples_of(const std::string& quality) {
  for (const Quality& q : kQualities)
    if (quality == q.name) return q.samples;
  throw UsageError("--quality", "unknown quality '" + quality + "'", "draft, normal, final");
}

Shard parse_shard(const std::string& text) {
  const std::vector<std::string> parts = split(text, '/');
  if (parts.size() == 2) {
    const auto index = parse_number(parts[0]), count = parse_number(parts[1]);
    if (index && count && *index >= 0 && *index < *count && *count <= 65536 && *index == std::floor(*index) &&
        *count == std::floor(*count))
      return {static_cast<uint32_t>(*index), static_cast<uint32_t>(*count)};
  }
  throw UsageError("--shard", "'" + text + "' is no shard", "i/n with 0 <= i < n, e.g. 0/3");
}

/// What this verb's options say, checked.
struct Request {
  BakeJob job;
  fs::path output;
  std::optional<Shard> shard;
  bool resume = false, force = false, dry_run = false;
};

/// The state file that a bake leaves behind until its package stands.
fs::path state_path(const Request& request) {
  fs::path path = request.output;
  if (!request.shard) return path += ".state";
  path.replace_extension();
  return path += fmt::format(".shard-{}-of-{}", request.shard->index, request.shard->count);
}

BakeState open_state(const Request& request, const PreparedBake& bake, const Progress& progress) {
  const fs::path path = state_path(request);
  if (!fs::exists(path)) return BakeState::create(path, bake.header());
  if (!request.resume) {
    progress.warn(path.string() + " of an unfinished bake is replaced (--resume would have continued it)");
    return BakeState::create(path, bake.header());
  }
  BakeState state = BakeState::open(path);
  if (state.header().hash != bake.hash)
    throw Error(path.string(), "belongs to another scene or other options, so it cannot be resumed",
                "the options of the first run, or no --resume");
  if (state.header().isa != bake.header().isa)
    throw Error(path.string(), "was begun on another instruction set (" + state.header().isa + ")",
                bake.header().isa);
  return state;
}

bool up_to_date(const fs::path& output, const PreparedBake& bake) {
  try {
    const Manifest manifest = Package::open(output).manifest();
    const auto found = manifest.facts.find("result_hash");
    return found != manifest.facts.end() && found->second == bake.result_hash();
  } catch (const Error&) {
    return false;  // no package, or one to replace
  }
}

void check_writable(const fs::path& output) {
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw Error(output.string(), "cannot be written: no such folder " + folder.string());
  if (fs::exists(output) && !fs::exists(output / "manifest.json"))
    throw Error(output.string(), "exists and is no package, so it is left alone");
}

int execute(const Request& request, const Options& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  check_writable(request.output);
  const PreparedBake bake(request.job, progress);
  if (request.dry_run) {
    const AtlasReport& report = bake.atlas.report;
    fmt::print("{}: {} triangles, {} lamps in {} groups\n", request.job.scene.string(), bake.world.size(),
               bake.lamps.size(), bake.scene.groups.size());
    fmt::print(
        "atlas: {} page(s) of {} x {}, {:.4g} texels/m, {} charts, {} receivers, {} invalid, utilisation "
        "{:.1f} %, "
        "stretch mean {:.2f} max {:.2f}, {} triangles with a visible back\n",
        bake.atlas.pages, bake.atlas.width, bake.atlas.height, static_cast<double>(bake.atlas.density),
        report.charts, bake.receivers.size(), report.invalid, 100 * report.utilisation, report.stretch_mean,
        report.stretch_max, report.twins);
    return kDone;
  }
  if (!request.force && !request.shard && up_to_date(request.output, bake)) {
    if (!options.quiet) fmt::print("{} is up to date (--force bakes again)\n", request.output.string());
    return kDone;
  }
  BakeState state = open_state(request, bake, progress);
  run_bake(bake, request.shard.value_or(Shard{}), state, progress);
  if (request.shard) {
    if (!options.quiet)
      fmt::print("{}: done in {:.1f} s; `sconce merge` joins the shards\n", state.path().string(), seconds());
    return kDone;
  }
  std::map<std::string, Provenance> provenance;
  for (const auto& [key, value] : options.provenance()) provenance[key] = {value.value, value.source};
  const Manifest manifest = write_result(bake, std::span(&state, 1), request.output, provenance, progress);
  std::error_code ignored;
  fs::remove(state.path(), ignored);
  if (!options.quiet || options.json) print_result(manifest, request.output, seconds(), options.json);
  return kDone;
}

}  // namespace

int run_bake(int argc, const char* const* argv) {
  Options options("bake", "Computes one lightmap per light group of a scene and writes them as a package.");
  Request request;
  std::string scene, output, shard, quality = "normal", denoise = "off";
  int samples = 0, bounces = -1, seed = 1, page = 0;
  double density = 0, noise = 0, photons = 0;
  bool direct_estimate = false;
  BakeJob& job = request.job;
  options.positional("SCENE", &scene,
                     "glTF (.glb, .gltf) or OBJ file; SCENE.toml beside it adds lights, groups, options");
  options.option("-o,--output", &output, "package to write (default: NAME.sconce beside the scene)");
  options.option("--groups", &job.grouping, "how lights become groups: auto, named, per-light, one");
  options.option("--solver", &job.solver,
                 "how light travels: radiosity, path, photon, or external:CMD, a program run once per group");
  options.option("--atlas", &page, "page size in texels; the density follows (default: 1024)");
  options.option("--density", &density, "texels per metre; pages follow, up to 4096 each");
  options.option("--quality", &quality, "draft, normal or final: 32, 128 or 1024 samples");
  options.option("--samples", &samples, "paths per texel, instead of --quality");
  options.option("--noise", &noise, "stop a texel early at this relative standard error, e.g. 2%");
  options.option("--bounces", &bounces, "reflections; 0 = direct light only, -1 = unbounded");
  options.option("--cloud", &job.params.cloud,
                 "radiosity solver: gather samples (default: one for four texels, 4096 to 65536)");
  options.option("--photons", &photons,
                 "photon solver: emitted by all lamps together (default: 4 per texel, 0.5 to 4 M)");
  options.flag("--direct-estimate", &direct_estimate,
               "photon solver: texels show the map itself, no final gather");
  options.option("--encoding", &job.encoding, "f16 or f32, and exceptions by group: f16,ceiling=f32");
  options.option("--denoise", &denoise,
                 "on: one filter for all groups, guided by their noise; raw layers are kept (default: off)");
  options.option("--seed", &seed, "random seed");
  options.option("--shard", &shard, "i/n: bake only this part of the texels; see merge");
  options.flag("--resume", &request.resume, "continue an interrupted bake");
  options.flag("--force", &request.force, "bake even if the package is up to date");
  options.flag("--dry-run", &request.dry_run, "report groups and atlas, bake nothing");
  if (const auto code = options.parse(argc, argv)) return *code;
  job.scene = fs::absolute(scene);
  options.apply_file(fs::path(job.scene).replace_extension(".toml").string(), "side file");

  if (page < 0 || (page > 0 && page < 32) || page > 16384)
    throw UsageError("--atlas", fmt::format("{} is out of range", page), "32 to 16384");
  if (density < 0 || !(density < 1e5))
    throw UsageError("--density", fmt::format("{} is out of range", density), "above 0, below 100000");
  if (page > 0 && density > 0) throw UsageError("--atlas", "cannot stand beside --density");
  if (samples < 0 || samples > 1 << 24)
    throw UsageError("--samples", fmt::format("{} is out of range", samples), "1 to 16777216");
  if (bounces < -1) throw UsageError("--bounces", fmt::format("{} is out of range", bounces), "-1 or more");
  if (noise < 0 || noise >= 1)
    throw UsageError("--noise", fmt::format("{} is out of range", noise), "0 to 100 %");
  if (photons < 0 || photons > 1e9)
    throw UsageError("--photons", fmt::format("{} is out of range", photons), "1 to 1000000000");
  if (job.params.cloud < 0 || job.params.cloud > 1 << 24)
    throw UsageError("--cloud", fmt::format("{} is out of range", job.params.cloud), "1 to 16777216");
  const std::tuple<bool, const char*, const char*> own_options[] = {
      {job.params.cloud > 0, "--cloud", "radiosity"},
      {photons > 0, "--photons", "photon"},
      {direct_estimate, "--direct-estimate", "photon"}};
  for (const auto& [given, option, solver] : own_options)
    if (given && job.solver != solver)
      throw UsageError(option, "means nothing to the solver " + job.solver,
                       std::string("--solver ") + solver);
  if (noise > 0 && samples == 0) samples = samples_of("final");
  if (denoise != "on" && denoise != "off")
    throw UsageError("--denoise", "'" + denoise + "' is not understood", "on, off");
  job.denoise = denoise == "on";
  job.params.samples = samples > 0 ? samples : samples_of(quality);
  job.params.bounces = bounces;
  job.params.noise = noise;
  job.params.photons = static_cast<std::size_t>(photons);
  job.params.final_gather = !direct_estimate;
  job.params.seed = static_cast<uint32_t>(seed);
  job.atlas.density = static_cast<float>(density);
  job.atlas.page_size = density > 0 ? 0 : page > 0 ? page : 1024;
  parse_grouping(job.grouping);
  const bool runs_program = find_solver(job.solver).runs_program;
  if (runs_program && noise > 0) throw UsageError("--noise", "cannot stand beside --solver " + job.solver);
  if (runs_program && !shard.empty())
    throw UsageError("--shard", "cannot stand beside --solver " + job.solver + ", which bakes whole pages");
  if (!shard.empty()) request.shard = parse_shard(shard);
  request.output =
      output.empty() ? job.scene.parent_path() / (job.scene.stem().string() + ".sconce") : fs::path(output);
  if (!fs::exists(job.scene)) throw Error(scene, "no such file");

  const ThreadLimit threads(options.threads);
  return execute(request, options, make_progress(options));
}

}  // namespace sconce::app
