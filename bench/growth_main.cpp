// SPDX-License-Identifier: Apache-2.0
// How cost grows: time and peak memory of a solver against receivers, triangles, groups, bounces and threads,
// with the exponent of a power law fitted to each (least squares in logarithms), as Markdown. CPU time of all
// threads, which a busy machine does not lengthen much, and the wall clock.
// growth [SOLVER [SAMPLES [LARGEST]]]; LARGEST scales down the largest triangle count (default 1000000).
// Receivers are points spread over the surfaces by area: unwrapping is no solver's cost and is not part.
// Every row runs in a process of its own, so that its peak memory is its own.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "core/parallel.h"
#include "core/sobol.h"
#include "growth.h"
#include "scene/groups.h"
#include "scene/shapes.h"
#include "solve/solver.h"

using namespace sconce;

namespace {

struct Setup {
  std::string solver = "path";
  int samples = 32, bounces = -1, threads = 0;
  std::size_t receivers = 16384, triangles = 10000, lamps = 1, groups = 1;
};

struct Cost {
  double prepare = 0, solve = 0;  ///< seconds of CPU
  double wall = 0;                ///< seconds, of both
  double megabytes = 0;           ///< peak
};

/// A room with 16 tessellated spheres and a grid of lamps at its ceiling, dealt out to the groups in turn.
Scene make_scene(const Setup& setup) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f)), Vec3(-4, 0, -4), Vec3(4, 3, 4), true);
  const auto red = add_material(scene, "red", Rgb(0.6f, 0.2f, 0.1f));
  // A sphere of n rings has 4 n (n - 1) triangles.
  const int rings = static_cast<int>(std::lround(0.5 + std::sqrt(static_cast<double>(setup.triangles) / 64)));
  for (int i = 0; i < 16; ++i) {
    const Vec3 center(2 * (i % 4) - 3, 0.6f, 2 * (i / 4) - 3);
    add_sphere(scene, fmt::format("sphere {}", i), red, center, 0.5f, rings, false);
  }
  const auto glow = add_material(scene, "glow", Rgb(0), Rgb(1000));
  for (std::size_t i = 0; i < setup.lamps; ++i) {
    const Vec3 corner(static_cast<float>(i % 8) - 3.6f, 2.99f, static_cast<float>(i / 8) - 3.6f);
    const auto lamp =
        add_quad(scene, fmt::format("lamp {}", i), glow, corner, Vec3(0.2f, 0, 0), Vec3(0, 0, 0.2f));
    scene.instances[lamp.value].group_name = fmt::format("group {}", i % setup.groups);
  }
  assign_groups(scene, Grouping::automatic);
  return scene;
}

Cost run(const Setup& setup) {
  const ThreadLimit threads(setup.threads);
  const Scene scene = make_scene(setup);
  const World world = make_world(scene);
  std::vector<double> areas;
  for (std::size_t t = 0; t < world.size(); ++t) areas.push_back(static_cast<double>(world.area(t)));
  const AliasTable by_area(areas);
  BakeParams params;
  params.samples = setup.samples;
  params.bounces = setup.bounces;

  Cost cost;
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  const Tracer tracer(scene, world);
  const Lamps lamps(scene, world);
  const auto solver = find_solver(setup.solver).prepare({scene, world, tracer, lamps}, params, {});
  cost.prepare = cpu_seconds() - cpu;
  parallel_for(setup.receivers, 64, [&](std::size_t i) {
    Vec2 u = sobol_pair(static_cast<uint32_t>(i), 0, 1);
    const std::size_t t = by_area.sample(u.x);
    const Vec3 n = world.face_normals[t];
    const auto id = static_cast<uint32_t>(i);
    std::vector<GroupValue> out(scene.groups.size());
    solver->solve(Footprint::point(id, ReceiverKind::plane, {world.position(t, square_to_triangle(u)), n, n}),
                  out);
  });
  cost.solve = cpu_seconds() - cpu - cost.prepare;
  cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return cost;
}

Cost measure(const Setup& setup) {
  const auto [cost, megabytes] = in_own_process<Cost>([&] { return run(setup); });
  Cost out = cost;
  out.megabytes = megabytes;
  return out;
}

/// One sweep: a table of its rows, then the exponents.
/// @param at   what is varied, as the fit sees it
/// @param set  changes a setup to that value
template <class F>
void sweep(const char* what, const Setup& base, const std::vector<double>& at, F&& set) {
  fmt::print("\n| {} | prepare CPU s | solve CPU s | wall s | peak MB |\n|---:|---:|---:|---:|---:|\n", what);
  std::vector<double> prepare, solve, wall, memory;
  for (const double value : at) {
    Setup setup = base;
    set(setup, value);
    const Cost cost = measure(setup);
    prepare.push_back(cost.prepare);
    solve.push_back(cost.solve);
    wall.push_back(cost.wall);
    memory.push_back(cost.megabytes);
    fmt::print("| {:.0f} | {:.3f} | {:.3f} | {:.3f} | {:.0f} |\n", value, cost.prepare, cost.solve, cost.wall,
               cost.megabytes);
    std::fflush(stdout);
  }
  fmt::print("| exponent | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", exponent(at, prepare), exponent(at, solve),
             exponent(at, wall), exponent(at, memory));
}

}  // namespace

int main(int argc, char** argv) {
  Setup base;
  try {
    if (argc > 1) base.solver = argv[1];
    if (argc > 2) base.samples = std::atoi(argv[2]);
    const double largest = argc > 3 ? std::atof(argv[3]) : 1e6;
    find_solver(base.solver);
    if (base.samples < 1 || !(largest >= 1000))
      throw UsageError("growth", "SAMPLES or LARGEST too small", "1, 1000");
    base.triangles = static_cast<std::size_t>(std::min(largest, 1e4));

    fmt::print("# How cost grows: solver {}\n\n", base.solver);
    fmt::print(
        "{} samples; unless varied {} receivers, {} triangles, one lamp, unbounded reflections, {} threads. "
        "The last row of a table is the exponent p of cost = c x^p.\n",
        base.samples, base.receivers, base.triangles, std::thread::hardware_concurrency());
    std::fflush(stdout);  // a forked child would print it again
    // One sweep a quantity. To add one (ranks: start `mpirun -n N` in measure() instead of a fork), add a
    // field to Setup and a line here.
    sweep("receivers", base, {4096, 16384, 65536},
          [](Setup& s, double v) { s.receivers = static_cast<std::size_t>(v); });
    sweep("triangles", base, {largest / 100, largest / 32, largest / 10, largest / 3.2, largest},
          [](Setup& s, double v) { s.triangles = static_cast<std::size_t>(v); });
    sweep("groups of 64 lamps", base, {1, 4, 16, 64}, [](Setup& s, double v) {
      s.lamps = 64;
      s.groups = static_cast<std::size_t>(v);
    });
    sweep("flights (bounces + 1)", base, {1, 2, 3, 5, 9},
          [](Setup& s, double v) { s.bounces = static_cast<int>(v) - 1; });
    std::vector<double> threads;
    for (unsigned n = 1; n < std::thread::hardware_concurrency(); n *= 2) threads.push_back(n);
    threads.push_back(std::thread::hardware_concurrency());
    sweep("threads", base, threads, [](Setup& s, double v) { s.threads = static_cast<int>(v); });
  } catch (const std::exception& error) {
    fmt::print(stderr, "growth: {}\n", error.what());
    return 1;
  }
}
