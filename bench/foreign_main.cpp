// SPDX-License-Identifier: Apache-2.0
// Indirect light for a foreign renderer against its triangles, as Markdown: what it takes to make the
// operator and to update the ambient term of all vertices for a lamp that moves. The renderer is the tests'
// own and its time is not counted. foreign [LARGEST [SLOTS [RAYS]]]
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "detect/realtime.h"
#include "detect/synthetic_host.h"
#include "scene/shapes.h"

using namespace sconce;

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}
double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A room with 16 tessellated spheres.
Scene make_scene(double triangles) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f)), Vec3(-4, 0, -4), Vec3(4, 3, 4), true);
  const auto red = add_material(scene, "red", Rgb(0.6f, 0.2f, 0.1f));
  const int rings = static_cast<int>(std::lround(0.5 + std::sqrt(triangles / 64)));
  for (int i = 0; i < 16; ++i)
    add_sphere(scene, "sphere", red,
               Vec3(2 * static_cast<float>(i % 4) - 3, 0.6f, 2 * static_cast<float>(i / 4) - 3), 0.5f, rings,
               false);
  return scene;
}

void row(double triangles, const TransferParams& params) {
  const Scene scene = make_scene(triangles);
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const TracedScene traced{scene, world, tracer};
  SyntheticHost host{world, {{{Rgb(), Rgb(), Rgb(0.7f)}}, {{Rgb(), Rgb(), Rgb(0.6f, 0.2f, 0.1f)}}}};
  const auto detecting = Clock::now();
  const Detection detection = detect_materials(scene, world, host.renderer());
  const double detect = since(detecting);
  const auto start = Clock::now();
  const double before = cpu();
  std::vector<uint32_t> all(world.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  RealtimeRadiosity radiosity(traced, vertex_receivers(traced),
                              face_cells(all, texels_by_area(world, all, 0.1f, 128)), host.renderer(),
                              detection, params);
  const double wall = since(start), seconds = cpu() - before;
  double least = 1e30, used = 0;
  constexpr int kFrames = 20;
  for (int frame = 0; frame < kFrames; ++frame) {
    host.lamps = {{Vec3(0.1f * static_cast<float>(frame), 2, 0), Rgb(3)}};
    const FrameReport report = radiosity.update();
    least = std::min(least, report.solve_milliseconds), used += report.solve_milliseconds;
  }
  fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} |\n", world.size(),
             radiosity.ambient().size(), detect, wall, seconds,
             static_cast<double>(radiosity.transfer().bytes()) / 1e6, least, used / kFrames);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 300000;
  TransferParams params;
  params.gather = argc > 2 ? static_cast<std::size_t>(std::atoi(argv[2])) : 16384;
  params.rays = argc > 3 ? std::atoi(argv[3]) : 256;
  params.keep_sums = true;
  fmt::print(
      "| triangles | vertices | detect s | operator s | CPU s | MB | update ms, least | mean |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const double triangles : {1000.0, 3000.0, 10000.0, 30000.0, 100000.0, 300000.0})
    if (triangles <= largest) row(triangles, params);
}
