// SPDX-License-Identifier: Apache-2.0
// Denoised at few samples against undenoised at many, per group and for all light together, over all texels
// of an atlas: relmse, the mean of (x - r)^2 / (r^2 + (mean / 10)^2); mse, over the squared mean; both freed
// of the reference's noise and weighted by area; stated, what the texels' errors say the mse is; mean, how
// far the layer's mean is off; gain, error of the many over error of the few denoised. Default: three scenes
// below SCONCE_TEST_DATA; or denoise SCENE... Options by environment: LOW (64) and HIGH (512) samples,
// REFERENCE (1024), PAGE (256; the kitchen 512), SOLVER (path), CACHE (folder that keeps the bakes for the
// next run).
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "core/parallel.h"
#include "gather/lit_scene.h"
#include "import/import.h"
#include "setting.h"
#include "solve/bake.h"
#include "solve/denoise.h"

using namespace sconce;

namespace {

using Values = std::vector<std::vector<GroupValue>>;  // per group and texel

struct Bench : LitAtlas {
  std::vector<double> areas;

  Bench(Scene&& s, const char* page)
      : LitAtlas(std::move(s), Grouping::automatic, std::stoi(setting("PAGE", page))) {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      areas.push_back(static_cast<double>(receivers.footprint(i).area));
  }

  Values bake(const std::string& name, int samples, uint32_t seed) const {
    BakeParams params;
    params.samples = samples;
    params.seed = seed;
    const std::string solver_name = setting("SOLVER", "path");
    const std::string cache = setting("CACHE", std::filesystem::temp_directory_path().c_str());
    const std::filesystem::path path =
        std::filesystem::path(cache) /
        fmt::format("denoise-{}-{}-{}-{}-{}.state", name, solver_name, samples, seed, atlas.width);
    const BakeHeader header{
        name, isa(), static_cast<uint32_t>(scene.groups.size()), receivers.size(), TexelReceivers::kTile, {}};
    const bool kept = std::getenv("CACHE") != nullptr && std::filesystem::exists(path);
    Values values;
    {
      BakeState state = kept ? BakeState::open(path, true) : BakeState::create(path, header);
      if (const auto tiles = missing_tiles(std::span(&state, 1), params); !tiles.empty()) {
        const std::vector<uint8_t> wanted(scene.groups.size(), 1);
        const SolveContext context{scene, world, tracer, lamps, &atlas, &receivers};
        const auto solver = find_solver(solver_name).prepare(context, params, {});
        bake_tiles(*solver, params, receivers, wanted, tiles, state, {});
      }
      for (uint32_t g = 0; g < scene.groups.size(); ++g)
        values.push_back(collect_values(std::span(&state, 1), params, g));
    }
    if (std::getenv("CACHE") == nullptr) std::filesystem::remove(path);
    return values;
  }
};

/// Area-weighted means over the texels of one group; relative to the mean, or each texel to itself.
struct Score {
  double mse = 0, relative = 0, mean = 0, stated = 0;
};

Score score(const Bench& bench, const std::vector<GroupValue>& x, const std::vector<GroupValue>& reference) {
  double area = 0, mean = 0;
  for (std::size_t i = 0; i < bench.areas.size(); ++i) {
    area += bench.areas[i];
    mean += bench.areas[i] * static_cast<double>(luminance(reference[i].illuminance));
  }
  mean /= area;
  Score s;
  for (std::size_t i = 0; i < bench.areas.size(); ++i) {
    const double r = static_cast<double>(luminance(reference[i].illuminance)),
                 d = static_cast<double>(luminance(x[i].illuminance)) - r,
                 noise = static_cast<double>(reference[i].error), own = static_cast<double>(x[i].error);
    const double squared = d * d - noise * noise;
    s.mse += bench.areas[i] * squared;
    s.relative += bench.areas[i] * squared / (r * r + 1e-2 * mean * mean);
    s.mean += bench.areas[i] * d;
    s.stated += bench.areas[i] * own * own;
  }
  s.mse /= area * mean * mean;
  s.stated /= area * mean * mean;
  s.relative /= area;
  s.mean /= area * mean;
  return s;
}

/// All groups' light together; their errors as if independent.
std::vector<GroupValue> sum(const Values& values) {
  std::vector<GroupValue> all(values.front().size());
  for (const std::vector<GroupValue>& group : values)
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].illuminance += group[i].illuminance;
      all[i].error = std::hypot(all[i].error, group[i].error);
    }
  return all;
}

void run(const std::string& path) {
  Scene scene = import_scene(path);
  const std::string name = std::filesystem::path(path).stem().string();
  const Bench bench(std::move(scene), name == "luxcore-kitchen" ? "512" : "256");
  const std::size_t groups = bench.scene.groups.size();
  const int low_samples = std::stoi(setting("LOW", "64")), high_samples = std::stoi(setting("HIGH", "512"));
  const auto low = bench.bake(name, low_samples, 1), high = bench.bake(name, high_samples, 2),
             reference = bench.bake(name, std::stoi(setting("REFERENCE", "1024")), 3);
  const auto start = std::chrono::steady_clock::now();
  const TexelGraph graph = make_texel_graph(bench.receivers, bench.tracer);
  const auto linked = std::chrono::steady_clock::now();
  const auto clean = denoise(graph, low), clean_high = denoise(graph, high);
  const auto end = std::chrono::steady_clock::now();
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  fmt::print("{}: {} texels, {}, page {}; neighbours {:.2f} s, denoising {:.2f} s\n", name,
             bench.receivers.size(), setting("SOLVER", "path"), bench.atlas.width, seconds(start, linked),
             seconds(linked, end) / 2);
  fmt::print("{:<20}", "");
  for (const int samples : {low_samples, high_samples})
    fmt::print("{:>28}{:>37}", fmt::format("raw {}", samples), fmt::format("denoised {}", samples));
  fmt::print("{:>16}\n{:<20}", "gain", "group");
  for (int i = 0; i < 2; ++i)
    fmt::print("{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>2}", "relmse", "mse", "stated", "relmse", "mse",
               "stated", "mean", "");
  fmt::print("{:>8}{:>8}\n", "relmse", "mse");
  const auto row = [&](const std::string& group, const std::vector<GroupValue>& few,
                       const std::vector<GroupValue>& few_clean, const std::vector<GroupValue>& many,
                       const std::vector<GroupValue>& many_clean, const std::vector<GroupValue>& truth) {
    fmt::print("{:<20}", group);
    const Score low_score = score(bench, few_clean, truth), high_score = score(bench, many, truth);
    for (const auto& [before, after] :
         {std::pair(score(bench, few, truth), low_score), {high_score, score(bench, many_clean, truth)}})
      fmt::print("{:>9.2e}{:>9.2e}{:>9.2e}{:>9.2e}{:>9.2e}{:>9.2e}{:>8.2f}%{:>2}", before.relative,
                 before.mse, before.stated, after.relative, after.mse, after.stated, 100 * after.mean, "");
    fmt::print("{:>7.2f}x{:>7.2f}x\n", high_score.relative / low_score.relative,
               high_score.mse / low_score.mse);
  };
  for (std::size_t g = 0; g < groups; ++g)
    row(bench.scene.groups[g].name, low[g], clean[g], high[g], clean_high[g], reference[g]);
  row("all of them", sum(low), sum(clean), sum(high), sum(clean_high), sum(reference));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (const std::string& scene :
         scenes_of(argc, argv, {"cornell-two-lights", "modern-hall", "luxcore-kitchen"}))
      run(scene);
  } catch (const std::exception& error) {
    fmt::print(stderr, "denoise: {}\n", error.what());
    return 1;
  }
}
