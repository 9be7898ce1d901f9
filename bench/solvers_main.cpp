// SPDX-License-Identifier: Apache-2.0
// Solvers against `path` at convergence, on texels spread evenly over a scene's atlas: per group the error of
// the mean and the relative RMSE, both freed of the reference's noise (contract.md), and the time at equal
// error. Default: three scenes below SCONCE_TEST_DATA; or solvers SCENE.
// Options by environment: TEXELS (1024), REFERENCE paths per texel (16384), PAGE (512), BOUNCES (-1), SAMPLES
// (list, "64 1024"), CLOUD (0), SOLVERS ("path radiosity photon").
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <sstream>

#include "core/parallel.h"
#include "gather/lit_scene.h"
#include "import/import.h"
#include "setting.h"
#include "solve/solver.h"

using namespace sconce;

namespace {

using Values = std::vector<std::vector<GroupValue>>;  // per texel, per group

template <class T>
std::vector<T> list(const std::string& text) {
  std::istringstream in(text);
  std::vector<T> result;
  for (T item; in >> item;) result.push_back(item);
  return result;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Bench : LitAtlas {
  std::vector<std::size_t> texels;

  Bench(Scene&& s, int page, std::size_t count) : LitAtlas(std::move(s), Grouping::automatic, page) {
    count = std::min(count, receivers.size());
    for (std::size_t i = 0; i < count; ++i) texels.push_back((2 * i + 1) * receivers.size() / (2 * count));
  }

  Values solve(const Solver& solver) const {
    Values values(texels.size());
    parallel_for(texels.size(), 4, [&](std::size_t i) {
      values[i].resize(scene.groups.size());
      solver.solve(receivers.footprint(texels[i]), values[i]);
    });
    return values;
  }
};

/// Means over texels and channels.
struct Error {
  double mean = 0, rmse = 0;  ///< relative to the reference's mean
};

Error error_of(const Values& x, const Values& s0, const Values& s1, std::size_t g, bool own_noise) {
  double mean = 0, bias = 0, squares = 0, noise = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto l = [&](const Values& v) { return static_cast<double>(luminance(v[i][g].illuminance)); };
    const double r = (l(s0) + l(s1)) / 2, d = l(x) - r, own = static_cast<double>(x[i][g].error);
    mean += r;
    bias += d;
    squares += d * d;
    noise += (l(s0) - l(s1)) * (l(s0) - l(s1)) / 4 + (own_noise ? 0 : own * own);
  }
  const double n = static_cast<double>(x.size());
  return {bias / mean, std::sqrt(std::max(0.0, squares - noise) / n) / (mean / n)};
}

void run(const std::string& path) {
  Scene scene = import_scene(path);
  const Bench bench(std::move(scene), std::stoi(setting("PAGE", "512")),
                    std::stoul(setting("TEXELS", "1024")));
  const SolveContext context{bench.scene, bench.world,  bench.tracer,
                             bench.lamps, &bench.atlas, &bench.receivers};
  BakeParams params;
  params.bounces = std::stoi(setting("BOUNCES", "-1"));
  params.cloud = std::stoi(setting("CLOUD", "0"));
  Values reference[2];
  params.samples = std::stoi(setting("REFERENCE", "16384"));
  for (const uint32_t half : {0u, 1u}) {
    params.seed = 1000 + half;
    reference[half] = bench.solve(*find_solver("path").prepare(context, params, {}));
  }
  fmt::print("{}: {} texels of {}, {} bounces\n", path.substr(path.rfind('/') + 1), bench.texels.size(),
             bench.receivers.size(), params.bounces < 0 ? "all" : std::to_string(params.bounces));
  fmt::print("{:<12}{:>8}{:>9}{:>9}", "solver", "samples", "ready", "solve");
  for (const LightGroup& group : bench.scene.groups) fmt::print("{:>24}", group.name);
  fmt::print("\n{:>38}", "");
  for (std::size_t g = 0; g < bench.scene.groups.size(); ++g)
    fmt::print("{:>8}{:>8}{:>8}", "mean", "rmse", "bias");
  fmt::print("\n");
  params.seed = 1;
  for (const std::string& name : list<std::string>(setting("SOLVERS", "path radiosity photon")))
    for (const int samples : list<int>(setting("SAMPLES", "64 1024"))) {
      params.samples = samples;
      auto start = std::chrono::steady_clock::now();
      const auto solver = find_solver(name).prepare(context, params, {});
      const double ready = seconds_since(start);
      start = std::chrono::steady_clock::now();
      const Values values = bench.solve(*solver);
      fmt::print("{:<12}{:>8}{:>8.2f}s{:>8.2f}s", name, samples, ready, seconds_since(start));
      for (std::size_t g = 0; g < bench.scene.groups.size(); ++g) {
        const Error all = error_of(values, reference[0], reference[1], g, true),
                    bias = error_of(values, reference[0], reference[1], g, false);
        fmt::print("{:>7.2f}%{:>7.2f}%{:>7.2f}%", 100 * all.mean, 100 * all.rmse, 100 * bias.rmse);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string data = setting("SCONCE_TEST_DATA", "../shared/data");
  try {
    if (argc > 1) {
      run(argv[1]);
    } else {
      for (const char* name : {"modern-hall", "luxcore-kitchen", "cornell-two-lights"})
        run(data + "/glb/" + name + ".glb");
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "solvers: {}\n", error.what());
    return 1;
  }
}
