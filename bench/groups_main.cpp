// SPDX-License-Identifier: Apache-2.0
// What light groups cost: time of a bake with one group, named groups and one group per lamp at the same
// number of paths; and each group's noise against that of a bake of its lamps alone (the others not emitting)
// with the same number of paths. Default: modern-hall below SCONCE_TEST_DATA at 512 x 512 texels; or groups
// SCENE [SAMPLES]. Every 32nd tile is measured.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <mutex>

#include "core/parallel.h"
#include "import/import.h"
#include "receive/atlas.h"
#include "scene/groups.h"
#include "solve/solver.h"

using namespace sconce;

namespace {

constexpr std::size_t kEvery = 32;

struct Result {
  double seconds = 0;
  std::vector<double> mean, error;  ///< per group: area-free mean of luminance, rms of its standard error
  std::vector<std::string> names;
};

/// Bakes the measured tiles of a scene whose charts are `receivers`.
Result bake(const Scene& scene, const World& world, const Tracer& tracer, const TexelReceivers& receivers,
            int samples) {
  const Lamps lamps(scene, world);
  BakeParams params;
  params.samples = samples;
  const auto solver = find_solver("path").prepare({scene, world, tracer, lamps}, params, {});
  const std::size_t groups = scene.groups.size(), tiles = (receivers.tiles() + kEvery - 1) / kEvery;
  std::vector<std::vector<double>> sums(tiles, std::vector<double>(2 * groups));
  std::vector<std::size_t> counts(tiles);
  const auto start = std::chrono::steady_clock::now();
  parallel_for(tiles, 1, [&](std::size_t k) {
    std::vector<GroupValue> out(groups);
    const std::size_t first = k * kEvery * TexelReceivers::kTile;
    for (std::size_t i = first; i < std::min(receivers.size(), first + TexelReceivers::kTile);
         ++i, ++counts[k]) {
      solver->solve(receivers.footprint(i), out);
      for (std::size_t g = 0; g < groups; ++g) {
        sums[k][2 * g] += static_cast<double>(luminance(out[g].illuminance));
        sums[k][2 * g + 1] += static_cast<double>(out[g].error) * static_cast<double>(out[g].error);
      }
    }
  });
  Result result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double count = 0;
  for (const std::size_t n : counts) count += static_cast<double>(n);
  for (std::size_t g = 0; g < groups; ++g) {
    double mean = 0, squares = 0;
    for (std::size_t k = 0; k < tiles; ++k) mean += sums[k][2 * g], squares += sums[k][2 * g + 1];
    result.mean.push_back(mean / count);
    result.error.push_back(std::sqrt(squares / count));
    result.names.push_back(scene.groups[g].name);
  }
  return result;
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const char* data = std::getenv("SCONCE_TEST_DATA");
  const std::string path =
      argc > 1 ? argv[1] : std::string(data != nullptr ? data : "../shared/data") + "/glb/modern-hall.glb";
  const int samples = argc > 2 ? std::atoi(argv[2]) : 64;
  try {
    Scene scene = import_scene(path);
    const World world = make_world(scene);
    const Tracer tracer(scene, world);
    AtlasParams params;
    params.page_size = 512;
    Atlas atlas = make_atlas(scene, world, tracer, params);
    const TexelReceivers receivers(world, tracer, atlas);

    const Grouping modes[] = {Grouping::one, Grouping::automatic, Grouping::per_light};
    std::vector<double> ratios[3];
    Result results[3];
    for (int round = 0; round < 5; ++round) {
      double base = 0;
      for (int m = 0; m < 3; ++m) {
        assign_groups(scene, modes[m]);
        results[m] = bake(scene, world, tracer, receivers, samples);
        if (m == 0) base = results[m].seconds;
        ratios[m].push_back(results[m].seconds / base);
      }
    }
    fmt::print("time at the same number of paths, median of five pairs\n");
    for (int m = 0; m < 3; ++m)
      fmt::print("  {:>3} groups: {:.3f} x one group ({:.2f} s)\n", results[m].names.size(),
                 median(ratios[m]), results[m].seconds);

    for (int m = 1; m < 3; ++m) {
      fmt::print("relative noise of {} groups, together and alone\n", results[m].names.size());
      for (std::size_t g = 0; g < results[m].names.size(); ++g) {
        assign_groups(scene, modes[m]);
        Scene alone = scene;
        for (Instance& instance : alone.instances) {
          if (!alone.emits(instance) || instance.group.value == g) continue;
          Material dark = alone[alone[instance.mesh].material];
          dark.emission = Rgb();
          alone.materials.push_back(dark);
          Mesh mesh = alone[instance.mesh];
          mesh.material = Id<Material>(alone.materials.size() - 1);
          alone.meshes.push_back(mesh);
          instance.mesh = Id<Mesh>(alone.meshes.size() - 1);
        }
        std::erase_if(alone.lights, [&](const Light& light) { return light.group.value != g; });
        const World alone_world = make_world(alone);
        const Result single = bake(alone, alone_world, tracer, receivers, samples);
        const double together = results[m].error[g] / results[m].mean[g],
                     by_itself = single.error[g] / single.mean[g];
        fmt::print("  {:<24} {:>8.1f} % {:>8.1f} %  {:.2f} x\n", results[m].names[g], 100 * together,
                   100 * by_itself, together / by_itself);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "groups: {}\n", error.what());
    return 1;
  }
}
