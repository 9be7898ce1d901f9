// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app.h"
#include "core/error.h"
#include "core/file_lock.h"
#include "core/parallel.h"
#include "core/text.h"
#include "transfer_job.h"

namespace sconce::app {

namespace {

/// Of those that change what is made: others would make bits differ that are the same.
std::string given_options(const Options& options) {
  const std::set<std::string> others{"PACKAGE", "resume", "quiet", "json", "threads", "config"};
  std::string text;
  for (const auto& [name, value] : options.provenance())
    if (value.source != "default" && !others.contains(name)) text += name + "=" + value.value + " ";
  return trim(text);
}

/// What the chapter's rows are made with where nothing else is said: its own numbers.
void use_chapter(const Options& options, const std::string& choice, TransferParams& params) {
  const auto given = options.provenance();
  const auto is_default = [&](const char* name) { return given.at(name).source == "default"; };
  params.method = TransferMethod::chapter;
  if (is_default("coefficients")) params.coefficients = 100;
  if (is_default("bounce-coefficients")) params.bounce_coefficients = 40;
  if (is_default("points")) params.points = 1;
  const auto it = std::find_if(kWeightings.begin(), kWeightings.end(),
                               [&](const auto& row) { return row.name == choice; });
  if (it == kWeightings.end())
    throw UsageError("option '--choice'", "unknown choice '" + choice + "'", "root-area, area, none");
  params.choice = it->weighting;
}

/// @return exit code when nothing is left to do
std::optional<int> read_job(int argc, const char* const* argv, Options& options, TransferJob& job) {
  std::string input, method = "fitted", choice = "root-area";
  bool lightmap = false, no_reflections = false;
  PictureOptions& picture = job.picture;
  TransferParams& params = job.params;
  int gather = static_cast<int>(params.gather), seed = 1;
  options.positional("PACKAGE", &input, "NAME.sconce; the operator goes into NAME.sconce/operators");
  options.flag("--lightmap", &lightmap, "for the lightmap, so that the camera stays free (default)");
  options.option("--camera", &picture.camera, "for the pixels of this camera instead");
  options.option("--size", &picture.size, "of the camera's picture: WIDTHxHEIGHT, or WIDTH (default: 640)");
  options.option("--gather", &gather, "samples of the cloud that light is gathered from, a power of four");
  options.option("--rays", &params.rays, "per receiver");
  options.option("--cluster", &params.cluster, "receivers that share a basis of 16 rows, a multiple of 16");
  options.option("--coefficients", &params.coefficients, "wavelet coefficients kept per basis");
  options.option("--bounce-coefficients", &params.bounce_coefficients,
                 "the same per node of the cloud, for light that was reflected");
  options.option("--points", &params.points, "where direct light is asked for, per sample of the cloud");
  options.option("--lights", &params.lights, "lamps at random places that rows are fitted to");
  options.option(
      "--method", &method,
      "fitted; or, to compare with, chapter: form factors between points, bounces by photons, plain "
      "rows of 100 and 40 coefficients, hours at full size; or exact: all coefficients as floats, "
      "gigabytes at full size");
  options.option(
      "--choice", &choice,
      "of the chapter's coefficients, the largest times: root-area (of the wavelet's support), area, "
      "none");
  options.option("--photons", &params.photons, "of the chapter: that the cloud sends");
  options.option("--nearest", &params.nearest, "of these, looked at from each sample of the cloud");
  options.option("--seed", &seed, "of the random numbers");
  options.flag("--no-reflections", &no_reflections, "no lobes of a camera's pixels that mirror");
  options.flag("--resume", &job.resume, "go on with what an interrupted transfer left");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (lightmap && !picture.camera.empty()) throw UsageError({}, "--lightmap and --camera exclude each other");
  if (!picture.size.empty() && picture.camera.empty()) throw UsageError({}, "--size needs --camera");
  if (picture.size.empty()) picture.size = "640";
  picture.check();
  params.gather = static_cast<std::size_t>(std::max(0, gather));
  params.seed = static_cast<uint32_t>(seed);
  if (method == "chapter")
    use_chapter(options, choice, params);
  else if (method == "exact")
    params.method = TransferMethod::exact;
  else if (method != "fitted")
    throw UsageError("option '--method'", "unknown method '" + method + "'", "fitted, chapter, exact");
  job.lobes = !no_reflections;
  job.package = input;
  job.options = given_options(options);
  return std::nullopt;
}

void report(const MadeOperator& made, const TransferJob& job, double seconds, const Options& options) {
  const auto& [operators, path, lobes_at] = made;
  const auto& [op, lobes] = operators;
  const auto bytes = std::filesystem::file_size(path);
  if (options.json) {
    nlohmann::ordered_json report = {{"input", job.package.string()},
                                     {"output", path.string()},
                                     {"receivers", op.gather.rows},
                                     {"gather", op.slots()},
                                     {"multiplications_per_receiver", op.gather.macs_per_row()},
                                     {"sweeps", op.sweeps},
                                     {"matrix_bytes", op.bytes()},
                                     {"bytes", bytes},
                                     {"seconds", seconds}};
    if (lobes)
      report["lobes"] = {{"output", lobes_at.string()},
                         {"receivers", lobes->gather.rows},
                         {"multiplications_per_receiver", lobes->gather.macs_per_row()},
                         {"bytes", std::filesystem::file_size(lobes_at)}};
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet) {
    fmt::print("{}: {} receivers, {} samples, {:.1f} MB, {:.1f} s\n", path.string(), op.gather.rows,
               op.slots(), static_cast<double>(bytes) / 1e6, seconds);
    if (lobes)
      fmt::print("{}: lobes of {} pixels that mirror, {:.1f} MB\n", lobes_at.string(), lobes->gather.rows,
                 static_cast<double>(std::filesystem::file_size(lobes_at)) / 1e6);
  }
  options.next({job.package.string()});
}

}  // namespace

int run_transfer(int argc, const char* const* argv) {
  RankSession session;
  return session.guard([&] {
    const auto start = std::chrono::steady_clock::now();
    Options options(
        "transfer",
        "Computes how direct light, wherever lamps will be, becomes indirect light on a package's "
        "lightmap or on a camera's pixels. 'sconce relight' uses it.",
        {"sconce transfer kitchen.sconce", "sconce transfer kitchen.sconce --camera stove --size 640x360",
         "sconce relight {PACKAGE} --light point,position=1,1.8,1,lumens=400"});
    TransferJob job;
    std::optional<int> code;
    std::optional<FileLock> lock;
    session.together([&] {
      code = read_job(argc, argv, options, job);
      if (!code && session.ranks().index == 0) lock.emplace(job.package);
    });
    if (code) return *code;
    const ThreadLimit threads(options.threads);
    const MadeOperator made = [&] {
      const Progress progress = make_progress(options);
      session.watch(progress.stop);
      return run_transfer_job(job, session, progress);
    }();
    report(made, job, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
           options);
    return int{kDone};
  });
}

}  // namespace sconce::app
