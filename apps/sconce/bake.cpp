// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app.h"
#include "bake_report.h"
#include "checkpoint.h"
#include "core/file_lock.h"
#include "core/parallel.h"
#include "core/text.h"
#include "encode/choice.h"
#include "ranks.h"
#include "solve/timing.h"
#include "transfer_job.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Quality {
  const char* name;
  double noise;      ///< of all light at a texel, relative standard error
  int most_samples;  ///< of a texel that does not get there
  int samples;       ///< what caches are made good enough for, and what programs are asked for
};
constexpr Quality kDraft{"draft", 0.1, 256, 32}, kNormal{"normal", 0.03, 2048, 128},
    kFinal{"final", 0.01, 16384, 1024};

Quality quality_of(const std::string& name) {
  for (const Quality& q : {kDraft, kNormal, kFinal})
    if (name == q.name) return q;
  throw UsageError("--quality", "unknown quality '" + name + "'", "draft, normal, final");
}

/// How long texels are worked at: so many samples, until a noise, as a quality says; or what programs take.
void set_effort(BakeParams& params, int samples, double noise, const Quality& quality, bool timed,
                bool runs_program) {
  params.noise = noise;
  params.samples = samples;
  if (timed) {
    params.cache_samples = kFinal.samples;  // how many fit is known only after the cache is made
    params.samples = kFinal.samples;
  } else if (samples == 0 && runs_program) {
    params.samples = quality.samples;
  } else if (samples == 0) {
    const Quality& asked = noise > 0 ? kFinal : quality;
    if (noise == 0) params.noise = asked.noise;
    params.samples = asked.most_samples;
    params.cache_samples = asked.samples;
  }
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

/// Options as they are given; they outlive their declarations, which tell where values came from.
struct Given {
  std::string scene, output, shard, quality = "normal", basis = "flat";
  int samples = 0, bounces = -1, seed = 1, page = 0;
  double density = 0, noise = 0, photons = 0;
  bool direct_estimate = false;
  std::string denoise = "off";
  double time = 0, max_error = 0.01;
};

/// What this verb's options say, checked.
struct Request {
  Given given;
  BakeJob job;
  fs::path output;
  std::optional<Shard> shard;
  bool resume = false, force = false, dry_run = false, movable = false;
};

/// The state file that a bake leaves behind until its package stands.
fs::path state_path(const Request& request) {
  fs::path path = request.output;
  if (!request.shard) return path += ".state";
  path.replace_extension();
  return path += fmt::format(".shard-{}-of-{}", request.shard->index, request.shard->count);
}

void check_writable(const fs::path& output) {
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw Error(output.string(), "cannot be written: no such folder " + folder.string());
  if (fs::exists(output) && !fs::exists(output / "manifest.json"))
    throw Error(output.string(), "exists and is no package, so it is left alone");
}

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t values_of(const PreparedBake& bake) {
  return bake.scene.groups.size() * coefficients(bake.job.params.basis);
}

/// Where the command line says how long texels are worked at, what a file says of that counts for nothing.
void prefer_command_line(const Options& options, Given& given) {
  const auto values = options.provenance();
  const auto said = [&](const char* key) { return values.at(key).source == "command line"; };
  if (!said("quality") && !said("samples") && !said("noise") && !said("time")) return;
  if (!said("samples")) given.samples = 0;
  if (!said("noise")) given.noise = 0;
  if (!said("time")) given.time = 0;
}

/// Samples that fit the time; leaves the solver with them. All ranks together.
int samples_in(double seconds, Solver& solver, const PreparedBake& bake, const Ranks& ranks) {
  if (!solver.set_samples(kBatches))
    throw UsageError("--time", "means nothing to the solver " + bake.job.solver, "radiosity, path, photon");
  int samples = samples_within(std::max(0.0, seconds) * ranks.count, solver, bake.receivers, values_of(bake),
                               clock_seconds);
  if (ranks.count > 1)
    for (const std::string& other : ranks.allgather(std::to_string(samples)))
      samples = std::min(samples, std::stoi(other));
  solver.set_samples(samples);
  return samples;
}

/// For `--dry-run`: what is computed once, and all texels as some take it.
std::optional<double> expected_seconds(const Request& request, const PreparedBake& bake, const Ranks& ranks,
                                       const Progress& progress) {
  if (request.given.time > 0) return request.given.time;
  if (bake.plan.count(true) == 0) return 0;
  if (find_solver(bake.job.solver).runs_program) return std::nullopt;
  const double start = clock_seconds();
  const auto solver = make_solver(bake, state_path(request), ranks, progress);
  const double once = clock_seconds() - start;
  const double share = request.shard ? request.shard->count : ranks.count;
  return once + seconds_for(*solver, bake.receivers, values_of(bake), clock_seconds) / share;
}

/// `--movable`: the lightmap's operator, unless one of this package stands.
void make_movable(const Request& request, const Options& options, RankSession& session,
                  const Progress& progress) {
  if (!request.movable) return;
  bool stands = false;
  session.together([&] { stands = !request.force && has_operator(Package::open(request.output), ""); });
  if (stands) return;
  TransferJob job;
  job.package = request.output;
  job.params.seed = request.job.params.seed;
  job.resume = request.resume;
  const MadeOperator made = run_transfer_job(job, session, progress);
  if (!options.quiet && !options.json)
    fmt::print("{}: {} texels, so that lamps may move\n", made.path.string(), made.operators.op.gather.rows);
}

int execute(const Request& request, const Options& options, RankSession& session, const Progress& progress) {
  const double start = clock_seconds();
  const auto seconds = [&] { return clock_seconds() - start; };
  const Ranks ranks = session.ranks();
  std::optional<PreparedBake> prepared;
  std::optional<FileLock> lock;
  double time = request.given.time;
  session.together([&] {
    check_writable(request.output);
    if (ranks.index == 0 && !request.dry_run)
      lock.emplace(request.shard ? state_path(request) : request.output);
    BakeJob job = request.job;
    if (time > 0 && request.resume && fs::exists(state_path(request))) {
      const BakeHeader begun = BakeState::open(state_path(request), false).header();
      job.params.samples = BakeJob::from_json(begun.job, state_path(request).string()).params.samples;
      time = 0;
    }
    // Shards are parts of a whole bake: what stands on one machine may stand on no other. How many samples
    // fit a time is not known before they are to be taken.
    const bool anew = request.force || request.shard || time > 0;
    prepared.emplace(job, progress, anew ? fs::path() : request.output, ranks);
    check_agreement(prepared->header().hash + (prepared->up_to_date() ? "stands" : ""), ranks);
  });
  const PreparedBake& bake = *prepared;
  if (request.dry_run) {
    print_plan(bake, expected_seconds(request, bake, ranks, progress), options.json);
    return kDone;
  }
  if (bake.up_to_date()) {
    if (!options.quiet) fmt::print("{} is up to date (--force bakes again)\n", request.output.string());
    make_movable(request, options, session, progress);
    options.next({request.output.string()});
    return kDone;
  }
  std::vector<BakeState> states;
  if (bake.plan.count(true) > 0) {
    const fs::path state = state_path(request);
    std::unique_ptr<Solver> solver;
    if (time > 0) {  // the checkpoint names the samples
      solver = make_solver(bake, state, ranks, progress);
      prepared->set_samples(samples_in(time - seconds(), *solver, bake, ranks));
    }
    Checkpoint checkpoint(state, bake.header(), request.resume, session, progress);
    if (!solver) solver = make_solver(bake, state, ranks, progress);
    const std::vector<std::size_t> tiles =
        checkpoint.todo(bake.job.params, request.shard.value_or(Shard{}), ranks);
    run_bake(bake, *solver, tiles, checkpoint.own(), progress);
    states = checkpoint.finish(session);
  }
  if (request.shard) {
    if (!options.quiet)
      fmt::print("{}: done in {:.1f} s; `sconce merge` joins the shards\n", state_path(request).string(),
                 seconds());
    return kDone;
  }
  session.together([&] {
    if (ranks.index != 0) return;
    std::map<std::string, Provenance> provenance;
    for (const auto& [key, value] : options.provenance()) provenance[key] = {value.value, value.source};
    const Manifest manifest = write_result(bake, states, request.output, provenance, progress);
    std::error_code ignored;
    for (const BakeState& state : states) fs::remove(state.path(), ignored);
    if (!options.quiet || options.json) print_result(bake, manifest, request.output, seconds(), options.json);
  });
  make_movable(request, options, session, progress);
  options.next({request.output.string()});
  return kDone;
}

void apply_side_options(Options& options, fs::path scene) {
  scene.replace_extension(".toml");
  options.apply_file(scene.string(), scene.filename().string());
}

void declare(Options& options, Request& request) {
  auto& [scene, output, shard, quality, basis, samples, bounces, seed, page, density, noise, photons,
         direct_estimate, denoise, time, max_error] = request.given;
  BakeJob& job = request.job;
  options.positional("SCENE", &scene,
                     "glTF, OBJ, FBX, COLLADA, 3DS, PLY, STL, L3D or Blender file; SCENE.toml beside it adds "
                     "lights, groups, options");
  options.option("-o,--output", &output, "package to write (default: NAME.sconce beside the scene)");
  options.option("--groups", &job.grouping, "how lights become groups: auto, named, per-light, one");
  options.option("--solver", &job.solver,
                 "how light travels: radiosity, path, photon, or external:CMD, a program run once per group");
  options.option("--atlas", &page, "page size in texels; the density follows (default: 1024)");
  options.option("--density", &density, "texels per metre; pages follow, up to 4096 each");
  options.option("--quality", &quality, "draft, normal or final: 10, 3 or 1 % noise of all light at a texel");
  options.option("--samples", &samples, "paths per texel, instead of --quality");
  options.option("--noise", &noise,
                 "a texel is done at this relative standard error, e.g. 2%, instead of --quality; with "
                 "--samples at the latest after these");
  options.duration("--time", &time, "as many samples as fit this time, e.g. 5m, instead of --samples");
  options.option("--bounces", &bounces, "reflections; 0 = direct light only, -1 = unbounded");
  options.option("--cloud", &job.params.cloud,
                 "radiosity solver: gather samples (default: one for four texels, 4096 to 65536)");
  options.option("--photons", &photons,
                 "photon solver: emitted by all lamps together (default: 4 per texel, 0.5 to 4 M)");
  options.flag("--direct-estimate", &direct_estimate,
               "photon solver: texels show the map itself, no final gather");
  options.option("--basis", &basis,
                 "flat, or sh1: layers also hold how light changes with the normal, so that normal maps are "
                 "seen (4 x the size)");
  options.option(
      "--encoding", &job.encoding,
      "f32, f16, exp8, rgbe8, srgbe8, multi8, bc6h, lum:ENCODING (luminance only, four groups to a "
      "texture) or auto; exceptions by group: f16,ceiling=lum:f16");
  options.option("--max-error", &max_error, "what --encoding auto may lose, e.g. 1% (the default)");
  options.option("--denoise", &denoise,
                 "on: one filter for all groups, guided by their noise; raw layers are kept (default: off)");
  options.option("--probes", &job.probes,
                 "also probes so many metres apart, all over the scene: light of all groups from all around, "
                 "for things that move");
  options.flag("--movable", &request.movable,
               "also what 'sconce transfer' makes, so that lamps can be taken out of their layers and moved");
  options.option("--seed", &seed, "random seed");
  options.option("--shard", &shard, "i/n: bake only this part of the texels; see merge");
  options.flag("--resume", &request.resume, "continue an interrupted bake");
  options.flag("--force", &request.force, "solve all groups anew, whatever of the package still holds");
  options.flag("--dry-run", &request.dry_run,
               "report texels, pages, megabytes, groups, which would be solved and how long it would take; "
               "bake nothing");
}

/// @return exit code when nothing is left to do
std::optional<int> read_request(int argc, const char* const* argv, Options& options, Request& request) {
  declare(options, request);
  if (const auto code = options.parse(argc, argv)) return *code;
  auto& [scene, output, shard, quality, basis, samples, bounces, seed, page, density, noise, photons,
         direct_estimate, denoise, time, max_error] = request.given;
  BakeJob& job = request.job;
  job.scene = fs::absolute(scene);
  apply_side_options(options, job.scene);
  prefer_command_line(options, request.given);

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
  if (time < 0 || (time > 0 && (samples > 0 || noise > 0 || !shard.empty())))
    throw UsageError("--time", "cannot stand beside --samples, --noise or --shard");
  if (job.probes < 0 || !(job.probes < 1e6))
    throw UsageError("--probes", fmt::format("{} is out of range", job.probes), "metres, above 0");
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
  if (!(max_error > 0 && max_error < 1))
    throw UsageError("--max-error", fmt::format("{} is out of range", max_error), "above 0, below 100 %");
  job.max_error = max_error;
  if (job.may_use_blocks()) job.atlas.gutter = 4;
  if (denoise != "on" && denoise != "off")
    throw UsageError("--denoise", "'" + denoise + "' is not understood", "on, off");
  job.denoise = denoise == "on";
  const bool runs_program = find_solver(job.solver).runs_program;
  set_effort(job.params, samples, noise, quality_of(quality), time > 0, runs_program);
  job.params.bounces = bounces;
  job.params.basis = find_basis(basis);
  job.params.photons = static_cast<std::size_t>(photons);
  job.params.final_gather = !direct_estimate;
  job.params.seed = static_cast<uint32_t>(seed);
  job.atlas.density = static_cast<float>(density);
  job.atlas.page_size = density > 0 ? 0 : page > 0 ? page : 1024;
  parse_grouping(job.grouping);
  if (job.params.basis != Basis::flat && (runs_program || direct_estimate))
    throw UsageError("--basis",
                     basis + " cannot stand beside " +
                         (runs_program ? "--solver " + job.solver : std::string("--direct-estimate")) +
                         ", which knows no directions",
                     "flat");
  if (runs_program && noise > 0) throw UsageError("--noise", "cannot stand beside --solver " + job.solver);
  if (runs_program && !shard.empty())
    throw UsageError("--shard", "cannot stand beside --solver " + job.solver + ", which bakes whole pages");
  if (!shard.empty() && request.movable)
    throw UsageError("--movable", "cannot stand beside --shard", "'sconce transfer' after 'sconce merge'");
  if (!shard.empty()) request.shard = parse_shard(shard);
  request.output =
      output.empty() ? job.scene.parent_path() / (job.scene.stem().string() + ".sconce") : fs::path(output);
  if (!fs::exists(job.scene)) throw Error(scene, "no such file");
  return std::nullopt;
}

}  // namespace

std::map<std::string, Options::Value> bake_options(const fs::path& scene) {
  Options options("bake", "");
  Request request;
  declare(options, request);
  const std::string path = scene.string();
  const char* const arguments[] = {path.c_str()};
  options.parse(1, arguments);
  apply_side_options(options, scene);
  return options.provenance();
}

int run_bake(int argc, const char* const* argv) {
  RankSession session;
  return session.guard([&] {
    Options options("bake", "Computes one lightmap per light group of a scene and writes them as a package.",
                    {"sconce bake kitchen.glb --quality draft", "sconce bake kitchen.glb --dry-run",
                     "sconce view {PACKAGE}"});
    Request request;
    std::optional<int> code;
    session.together([&] {
      code = read_request(argc, argv, options, request);
      if (code) return;
      if (request.shard && session.ranks().count > 1)
        throw UsageError("--shard", "cannot stand beside several MPI ranks: they share the texels already");
      if (find_solver(request.job.solver).runs_program && session.ranks().count > 1)
        throw UsageError("--solver " + request.job.solver,
                         "bakes whole pages, so ranks have nothing to share", "one process");
    });
    if (code) return *code;
    const ThreadLimit threads(options.threads);
    const Progress progress = make_progress(options);
    session.watch(progress.stop);
    return execute(request, options, session, progress);
  });
}

}  // namespace sconce::app
