// SPDX-License-Identifier: Apache-2.0
#include "transfer_job.h"

#include <fmt/format.h>

#include <optional>

#include "bake_job.h"
#include "checkpoint.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// All that rows of F depend on beside the scene.
std::string key_of(const TransferParams& p, const RelightReceivers& receivers) {
  std::string key =
      fmt::format("weighed {} {} {} {} {} {} {} {} {} {} {}", p.gather, p.rays, p.cluster, p.coefficients,
                  p.bounce_coefficients, p.points, p.lights, p.seed, receivers.source.count,
                  static_cast<int>(p.method), static_cast<int>(p.choice));
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) key += fmt::format(" {}", receivers.camera.frame[c][r]);
  return key + fmt::format(" {} {} {}", receivers.camera.yfov, receivers.width, receivers.height);
}

}  // namespace

MadeOperator run_transfer_job(const TransferJob& job, RankSession& session, const Progress& progress) {
  const Ranks ranks = session.ranks();
  std::optional<Package> package;
  std::optional<View> view;
  std::optional<TransferState> state;
  RelightReceivers receivers;
  std::string scene;
  MadeOperator made;
  fs::path file;
  session.together([&] {
    check(job.params);
    package.emplace(Package::open(job.package));
    view.emplace(*package);
    if (job.picture.camera.empty()) {
      receivers = texel_receivers(*package, *view, progress);
    } else {
      const Camera camera =
          job.picture.find_camera(view->scene(), [&] { return view->camera("", progress); });
      const PictureParams size = job.picture.params(camera);
      receivers = pixel_receivers(view->traced(), camera, size.width, size.height);
      if (!job.lobes) receivers.glossy = {};
    }
    scene = operator_scene(*package);
    made.path = operator_path(package->path(), job.picture.camera);
    if (!job.picture.camera.empty()) made.lobes_path = lobes_path(package->path(), job.picture.camera);
    file = fs::path(made.path) += ".state";
    std::error_code ec;
    if (ranks.index != 0) return;
    fs::create_directory(made.path.parent_path(), ec);
    if (ec) throw Error(made.path.string(), "cannot be written: " + ec.message());
    if (job.resume) return;
    for (const auto& [rank, other] : files_of_others(file)) fs::remove(other, ec);
  });
  // What others left is read by all before any goes on with its own.
  std::string key;
  TransferRecords left;
  session.together([&] {
    key = fmt::format("{} {} {} {}", SCONCE_VERSION, isa(), scene, key_of(job.params, receivers));
    check_agreement(key, ranks);
    if (!job.resume) return;
    std::vector<fs::path> files;
    for (const auto& [rank, other] : files_of_others(file)) files.push_back(other);
    if (fs::exists(file)) files.push_back(file);
    left = read_transfer_records(files, key);
  });
  session.together([&] { state.emplace(file_of_rank(file, ranks.index), key, job.resume, std::move(left)); });
  made.operators = make_operators(view->traced(), receivers, job.params, scene, {progress, &*state, ranks});
  auto& [op, lobes] = made.operators;
  op.options = job.options;
  if (lobes) lobes->options = job.options;
  session.together([&] {
    if (ranks.index != 0) return;
    std::error_code ec;
    // Those of another operator would not fit this one.
    if (!made.lobes_path.empty()) fs::remove(made.lobes_path, ec);
    write_operator(made.path, op);
    if (lobes) write_operator(made.lobes_path, *lobes);
  });
  state->remove();
  session.together([&] {
    std::error_code ec;
    if (ranks.index == 0)
      for (const auto& [rank, other] : files_of_others(file)) fs::remove(other, ec);
  });
  return made;
}

}  // namespace sconce::app
