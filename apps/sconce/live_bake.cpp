// SPDX-License-Identifier: Apache-2.0
#include "live_bake.h"

#include <fmt/format.h>
#include <unistd.h>

#include "bake_job.h"
#include "core/error.h"
#include "transfer_job.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Stage {
  int page, samples;
  bool denoise;
};
// The first is there in seconds; the last is what `bake --samples 128 --denoise on` gives.
constexpr Stage kStages[] = {{256, 8, true}, {512, 32, true}, {1024, 128, true}};

}  // namespace

void live_bake(const fs::path& scene, const Progress& progress,
               const std::function<void(fs::path)>& publish) {
  std::string folder = (fs::temp_directory_path() / "sconce-view-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) throw Error(folder, "cannot be written");
  for (const Stage& stage : kStages) {
    BakeJob job;
    job.scene = fs::absolute(scene);
    job.denoise = stage.denoise;
    job.atlas.page_size = stage.page;
    job.params.samples = stage.samples;
    const PreparedBake bake(job, progress);
    const fs::path name = fs::path(folder) / fmt::format("{}-{}", scene.stem().string(), stage.page);
    std::vector<BakeState> states;
    states.push_back(BakeState::create(fs::path(name) += ".state", bake.header()));
    run_bake(bake, Shard{}, states.front(), progress);
    const fs::path package = fs::path(name) += ".sconce";
    write_result(bake, states, package, {}, progress);
    publish(package);
  }
  // Then its lamps may be moved.
  TransferJob job;
  job.package = fs::path(folder) / fmt::format("{}-{}.sconce", scene.stem().string(), kStages[2].page);
  job.params.gather = 16384, job.params.rays = 256, job.params.coefficients = 512;
  RankSession alone;
  run_transfer_job(job, alone, progress);
  publish(job.package);
}

}  // namespace sconce::app
