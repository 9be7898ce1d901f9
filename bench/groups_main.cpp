// SPDX-License-Identifier: Apache-2.0
// What light groups cost: time of a bake with one group, named groups and one group per lamp at the same
// number of paths; and each group's noise against that of a bake of its lamps alone (the others not emitting)
// with the same number of paths, and what the common bake costs of the lone one's time where it goes on until
// the group has the lone one's noise. Default: modern-hall below SCONCE_TEST_DATA at 512 x 512 texels; or
// groups SCENE [SAMPLES [SOLVER]]; SCENE `eight` is a room with eight lamps. Every 32nd tile is measured.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "core/parallel.h"
#include "import/import.h"
#include "receive/atlas.h"
#include "scene/groups.h"
#include "scene/shapes.h"
#include "solve/solver.h"

using namespace sconce;

namespace {

constexpr std::size_t kEvery = 32;
constexpr int kRounds = 5;

struct Result {
  double seconds = 0;
  std::vector<double> mean, error;  ///< per group: area-free mean of luminance, rms of its standard error
  std::vector<std::string> names;
};

/// The measured tiles of a scene whose charts are `receivers`.
class Bench {
 public:
  Bench(const Scene& scene, const World& world, const Tracer& tracer, const TexelReceivers& receivers,
        int samples, const char* name)
      : scene_(scene), receivers_(receivers), lamps_(scene, world) {
    BakeParams params;
    params.samples = samples;
    solver_ = find_solver(name).prepare({scene, world, tracer, lamps_, nullptr, &receivers}, params, {});
  }

  Result bake() const {
    const std::size_t groups = scene_.groups.size(), tiles = (receivers_.tiles() + kEvery - 1) / kEvery;
    std::vector<std::vector<double>> sums(tiles, std::vector<double>(2 * groups));
    std::vector<std::size_t> counts(tiles);
    // CPU time of all threads: a busy machine does not lengthen it much.
    const std::clock_t start = std::clock();
    parallel_for(tiles, 1, [&](std::size_t k) {
      std::vector<GroupValue> out(groups);
      const std::size_t first = k * kEvery * TexelReceivers::kTile;
      for (std::size_t i = first; i < std::min(receivers_.size(), first + TexelReceivers::kTile);
           ++i, ++counts[k]) {
        solver_->solve(receivers_.footprint(i), out);
        for (std::size_t g = 0; g < groups; ++g) {
          sums[k][2 * g] += static_cast<double>(luminance(out[g].illuminance));
          sums[k][2 * g + 1] += static_cast<double>(out[g].error) * static_cast<double>(out[g].error);
        }
      }
    });
    Result result;
    result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    double count = 0;
    for (const std::size_t n : counts) count += static_cast<double>(n);
    for (std::size_t g = 0; g < groups; ++g) {
      double mean = 0, squares = 0;
      for (std::size_t k = 0; k < tiles; ++k) mean += sums[k][2 * g], squares += sums[k][2 * g + 1];
      result.mean.push_back(mean / count);
      result.error.push_back(std::sqrt(squares / count));
      result.names.push_back(scene_.groups[g].name);
    }
    return result;
  }

 private:
  const Scene& scene_;
  const TexelReceivers& receivers_;
  Lamps lamps_;
  std::unique_ptr<Solver> solver_;
};

/// The least time of five: what disturbs only lengthens it.
Result best(const Bench& bench) {
  Result result = bench.bake();
  for (int round = 1; round < kRounds; ++round)
    result.seconds = std::min(result.seconds, bench.bake().seconds);
  return result;
}

/// A furnished room with a grid of ceiling lamps.
Scene eight_lamps() {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f)), Vec3(-4, 0, -2), Vec3(4, 3, 2), true);
  const auto wood = add_material(scene, "wood", Rgb(0.5f, 0.35f, 0.2f));
  for (int i = 0; i < 4; ++i)
    add_box(scene, fmt::format("table {}", i), wood, Vec3(2 * i - 3.5f, 0, -0.5f),
            Vec3(2 * i - 2.5f, 0.8f, 0.5f), false);
  for (int i = 0; i < 8; ++i) {
    const auto glow = add_material(scene, fmt::format("glow {}", i), Rgb(0), Rgb(1000));
    add_quad(scene, fmt::format("lamp {}", i), glow,
             Vec3(2 * static_cast<float>(i / 2) - 3.1f, 2.99f, i % 2 == 0 ? -1.1f : 0.9f), Vec3(0.2f, 0, 0),
             Vec3(0, 0, 0.2f));
  }
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const char* data = std::getenv("SCONCE_TEST_DATA");
  const std::string path =
      argc > 1 ? argv[1] : std::string(data != nullptr ? data : "../shared/data") + "/glb/modern-hall.glb";
  const int samples = argc > 2 ? std::atoi(argv[2]) : 64;
  const char* solver = argc > 3 ? argv[3] : "radiosity";
  try {
    Scene scene = path == "eight" ? eight_lamps() : import_scene(path);
    const World world = make_world(scene);
    const Tracer tracer(scene, world);
    AtlasParams params;
    params.page_size = 512;
    Atlas atlas = make_atlas(scene, world, tracer, params);
    const TexelReceivers receivers(world, tracer, atlas);

    const Grouping modes[] = {Grouping::one, Grouping::automatic, Grouping::per_light};
    Result results[3];
    for (int m = 0; m < 3; ++m) {
      assign_groups(scene, modes[m]);
      results[m] = best(Bench(scene, world, tracer, receivers, samples, solver));
    }
    fmt::print("{}, solver {}, {} samples\nCPU time at the same number of paths, the least of {}\n", path,
               solver, samples, kRounds);
    for (const Result& result : results)
      fmt::print("  {:>3} groups: {:.3f} x one group ({:.3f} s)\n", result.names.size(),
                 result.seconds / results[0].seconds, result.seconds);

    for (int m = 1; m < 3; ++m) {
      if (results[m].names.size() == 1) continue;
      fmt::print("relative noise of {} groups, together and alone; cost to the same noise\n",
                 results[m].names.size());
      std::vector<double> costs;
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
        const Result single = best(Bench(alone, alone_world, tracer, receivers, samples, solver));
        const double together = results[m].error[g] / results[m].mean[g],
                     by_itself = single.error[g] / single.mean[g];
        const double ratio = together / by_itself;
        costs.push_back(results[m].seconds / single.seconds * ratio * ratio);
        fmt::print("  {:<24} {:>8.1f} % {:>8.1f} %  {:.2f} x  {:.2f} x\n", results[m].names[g],
                   100 * together, 100 * by_itself, ratio, costs.back());
      }
      fmt::print("  all of them, each to its own noise: {:.2f} x the mean lone bake\n",
                 *std::max_element(costs.begin(), costs.end()));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "groups: {}\n", error.what());
    return 1;
  }
}
