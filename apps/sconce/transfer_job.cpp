// SPDX-License-Identifier: Apache-2.0
#include "transfer_job.h"

#include <fmt/format.h>

#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// All that rows of F depend on beside the scene.
std::string key_of(const TransferParams& p, const RelightReceivers& receivers) {
  std::string key = fmt::format("{} {} {} {} {} {} {} {} {}", p.gather, p.rays, p.cluster, p.coefficients,
                                p.bounce_coefficients, p.points, p.lights, p.seed, receivers.source.count);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) key += fmt::format(" {}", receivers.camera.frame[c][r]);
  return key + fmt::format(" {} {} {}", receivers.camera.yfov, receivers.width, receivers.height);
}

}  // namespace

std::string given_options(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options.provenance())
    if (value.source != "default") text += name + "=" + value.value + " ";
  return trim(text);
}

MadeOperator run_transfer_job(const TransferJob& job, const Progress& progress) {
  const Package package = Package::open(job.package);
  const View view(package);
  RelightReceivers receivers;
  if (job.picture.camera.empty()) {
    receivers = texel_receivers(package, view, progress);
  } else {
    const Camera camera = job.picture.find_camera(view.scene(), [&] { return view.camera("", progress); });
    const PictureParams size = job.picture.params(camera);
    receivers = pixel_receivers(view, camera, size.width, size.height);
  }
  MadeOperator made;
  made.path = operator_path(package.path(), job.picture.camera);
  std::error_code ec;
  fs::create_directory(made.path.parent_path(), ec);
  const std::string scene = operator_scene(package);
  TransferState state(fs::path(made.path) += ".state",
                      fmt::format("{} {} {} {}", SCONCE_VERSION, isa(), scene, key_of(job.params, receivers)),
                      job.resume);
  made.op = make_operator(view.traced(), receivers, job.params, scene, {progress, &state});
  made.op.options = job.options;
  write_operator(made.path, made.op);
  state.remove();
  return made;
}

}  // namespace sconce::app
