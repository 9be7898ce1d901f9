// SPDX-License-Identifier: Apache-2.0
// How much the light of a bake differs between both sides of smooth seams that nothing stands on, in percent
// of its mean, before and after they are closed; as solved, and denoised. seams [SCENE...]; default: two
// scenes below SCONCE_TEST_DATA. By environment: PAGE (512), SAMPLES (64).
#include <fmt/format.h>

#include "core/scratch_folder.h"
#include "gather/lit_scene.h"
#include "import/import.h"
#include "receive/seam_difference.h"
#include "setting.h"
#include "solve/bake.h"
#include "solve/denoise.h"
#include "solve/texel_graph.h"

using namespace sconce;

namespace {

using Values = std::vector<std::vector<GroupValue>>;  // per group and texel

Values bake(const LitAtlas& lit, const std::filesystem::path& state_file) {
  BakeParams params;
  params.samples = std::stoi(setting("SAMPLES", "64"));
  BakeState state = BakeState::create(state_file, {"seams",
                                                   isa(),
                                                   static_cast<uint32_t>(lit.scene.groups.size()),
                                                   lit.receivers.size(),
                                                   TexelReceivers::kTile,
                                                   {}});
  const std::vector<uint8_t> wanted(lit.scene.groups.size(), 1);
  const SolveContext context{lit.scene, lit.world, lit.tracer, lit.lamps, &lit.atlas, &lit.receivers};
  const auto solver = find_solver("radiosity").prepare(context, params, {});
  bake_tiles(*solver, params, lit.receivers, wanted, missing_tiles(std::span(&state, 1), params), state, {});
  Values values;
  for (uint32_t g = 0; g < lit.scene.groups.size(); ++g)
    values.push_back(collect_values(std::span(&state, 1), params, g));
  return values;
}

/// Luminance of all groups together.
std::vector<Image> total(const LitAtlas& lit, const Values& values, const Seams* seams, double& mean) {
  std::vector<float> areas(lit.receivers.size());
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = lit.receivers.footprint(i).area;
  std::vector<Image> sum(static_cast<std::size_t>(lit.atlas.pages),
                         Image(lit.atlas.width, lit.atlas.height, {"Y"}));
  mean = 0;
  for (const auto& group : values) {
    const Layer layer = assemble_layer(group, lit.atlas, lit.receivers, areas, seams);
    mean += layer.mean_lux;
    for (std::size_t p = 0; p < sum.size(); ++p)
      for (std::size_t i = 0; i < sum[p].pixels(); ++i) {
        const float* v = &layer.pages[p].data[3 * i];
        sum[p].data[i] += luminance({v[0], v[1], v[2]});
      }
  }
  return sum;
}

void run(const std::filesystem::path& path) {
  const LitAtlas lit(import_scene(path), Grouping::automatic, std::stoi(setting("PAGE", "512")));
  const ScratchFolder folder;
  const Values solved = bake(lit, folder.path() / "x.state");
  const Values clean = denoise(make_texel_graph(lit.receivers, lit.tracer), solved);
  const Seams seams(lit.world, lit.tracer, lit.atlas);
  for (const auto& [what, values] : {std::pair("as solved", &solved), {"denoised", &clean}})
    for (const Seams* closing : {static_cast<const Seams*>(nullptr), &seams}) {
      double mean = 0;
      const std::vector<Image> pages = total(lit, *values, closing, mean);
      for (const float width : {0.0f, 2.0f}) {
        const SeamDifference d = across_seams(lit.world, lit.atlas, pages, &lit.tracer, width);
        fmt::print("| {} | {} | {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {:.1f} |\n",
                   path.stem().string(), what, width > 0 ? "2 texels across" : "all",
                   closing != nullptr ? "after" : "before", d.places.size(), 100 * d.rms / mean,
                   100 * d.at(0.5) / mean, 100 * d.at(0.95) / mean, 100 * d.at(0.999) / mean,
                   100 * d.largest / mean);
      }
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto scenes = scenes_of(argc, argv, {"modern-hall", "contemporary-bathroom"});
    fmt::print(
        "Difference between both sides of smooth seams that nothing stands on, in percent of the mean "
        "illuminance; four places per texel of seam.\n\n"
        "| scene | light | charts | seams closed | places | rms | half below | 95 % | 99.9 % | largest |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& scene : scenes) run(scene);
  } catch (const std::exception& error) {
    fmt::print(stderr, "seams: {}\n", error.what());
    return 1;
  }
}
