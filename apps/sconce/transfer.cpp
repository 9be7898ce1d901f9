// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "app.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "operator_path.h"
#include "picture_options.h"
#include "relight/precompute.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

std::string options_text(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options.provenance())
    if (value.source != "default") text += name + "=" + value.value + " ";
  return trim(text);
}

/// All that rows of F depend on beside the scene.
std::string key_of(const TransferParams& p, const RelightReceivers& receivers) {
  std::string key = fmt::format("{} {} {} {} {} {} {} {} {}", p.gather, p.rays, p.cluster, p.coefficients,
                                p.bounce_coefficients, p.points, p.lights, p.seed, receivers.source.count);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) key += fmt::format(" {}", receivers.camera.frame[c][r]);
  return key + fmt::format(" {} {} {}", receivers.camera.yfov, receivers.width, receivers.height);
}

}  // namespace

int run_transfer(int argc, const char* const* argv) {
  const auto start = std::chrono::steady_clock::now();
  std::string input;
  bool lightmap = false, resume = false;
  PictureOptions picture;
  TransferParams params;
  int gather = static_cast<int>(params.gather), seed = 1;
  Options options(
      "transfer",
      "Computes how direct light, wherever lamps will be, becomes indirect light on a package's "
      "lightmap or on a camera's pixels. 'sconce relight' uses it.",
      {"sconce transfer kitchen.sconce", "sconce transfer kitchen.sconce --camera stove --size 640x360",
       "sconce relight {PACKAGE} --light point,position=1,1.8,1,lumens=400"});
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
  options.option("--seed", &seed, "of the random numbers");
  options.flag("--resume", &resume, "go on with what an interrupted transfer left");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (lightmap && !picture.camera.empty()) throw UsageError({}, "--lightmap and --camera exclude each other");
  if (!picture.size.empty() && picture.camera.empty()) throw UsageError({}, "--size needs --camera");
  if (picture.size.empty()) picture.size = "640";
  picture.check();
  params.gather = static_cast<std::size_t>(std::max(0, gather));
  params.seed = static_cast<uint32_t>(seed);

  const ThreadLimit threads(options.threads);
  Operator op;
  fs::path path;
  {
    const Progress progress = make_progress(options);
    const Package package = Package::open(input);
    const View view(package);
    RelightReceivers receivers;
    if (picture.camera.empty()) {
      receivers = texel_receivers(package, view, progress);
    } else {
      const Camera camera = picture.find_camera(view.scene(), [&] { return view.camera("", progress); });
      const PictureParams size = picture.params(camera);
      receivers = pixel_receivers(view, camera, size.width, size.height);
    }
    path = operator_path(package.path(), picture.camera);
    std::error_code ec;
    fs::create_directory(path.parent_path(), ec);
    const std::string scene = operator_scene(package);
    TransferState state(fs::path(path) += ".state",
                        fmt::format("{} {} {} {}", SCONCE_VERSION, isa(), scene, key_of(params, receivers)),
                        resume);
    op = make_operator(view.traced(), receivers, params, scene, {progress, &state});
    op.options = options_text(options);
    write_operator(path, op);
    state.remove();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto bytes = fs::file_size(path);
  if (options.json) {
    const nlohmann::ordered_json report = {{"input", input},
                                           {"output", path.string()},
                                           {"receivers", op.gather.rows},
                                           {"gather", op.slots()},
                                           {"multiplications_per_receiver", op.gather.macs_per_row()},
                                           {"sweeps", op.sweeps},
                                           {"matrix_bytes", op.bytes()},
                                           {"bytes", bytes},
                                           {"seconds", seconds}};
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet) {
    fmt::print("{}: {} receivers, {} samples, {:.1f} MB, {:.1f} s\n", path.string(), op.gather.rows,
               op.slots(), static_cast<double>(bytes) / 1e6, seconds);
  }
  options.next({input});
  return kDone;
}

}  // namespace sconce::app
