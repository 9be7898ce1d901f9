// SPDX-License-Identifier: Apache-2.0
// Indirect light for a foreign renderer, as Markdown: what it takes to make the operator and to update the
// ambient term of all vertices for a lamp that moves, against the number of triangles; the error beside
// paths, and Keller's instant radiosity beside both; how fast the light is there after a jump; what a thing
// that moves costs. The renderer is the tests' own and its time is not counted. foreign [LARGEST [SLOTS
// [RAYS]]]
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "detect/realtime.h"
#include "instant_radiosity.h"
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

SyntheticLamp lamp_at(float x) {
  return {Vec3(x, 2, 0), Rgb(3)};
}

/// The room, its renderer, and all that is made for it.
struct Rig {
  Scene scene;
  World world{make_world(scene)};
  Tracer tracer{scene, world};
  TracedScene traced{scene, world, tracer};
  SyntheticHost host;
  double detect = 0, wall = 0, seconds = 0;  ///< s; the latter of CPU
  RelightReceivers receivers{vertex_receivers(traced)};
  std::unique_ptr<RealtimeRadiosity> radiosity;

  Rig(double triangles, const Rgb& spheres, const TransferParams& params)
      : scene(make_scene(triangles)), host{world, {{{Rgb(), Rgb(), Rgb(0.7f)}}, {{Rgb(), Rgb(), spheres}}}} {
    host.tracer = &tracer;
    const auto detecting = Clock::now();
    const Detection detection = detect_materials(scene, world, host.renderer());
    detect = since(detecting);
    const auto start = Clock::now();
    const double before = cpu();
    std::vector<uint32_t> all(world.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    radiosity = std::make_unique<RealtimeRadiosity>(traced, receivers,
                                                    face_cells(all, texels_by_area(world, all, 0.1f, 128)),
                                                    host.renderer(), detection, params);
    wall = since(start), seconds = cpu() - before;
  }
  LitRoom lit() const { return {traced, host.materials, host.lamps[0], host.unit}; }
};

/// Every so many of the receivers, to be checked.
std::vector<std::size_t> some(std::size_t count, std::size_t wanted) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; i += std::max<std::size_t>(1, count / wanted)) out.push_back(i);
  return out;
}

struct Difference {
  double rmse, mean;  ///< of the mean that is right; ratio of means
};
/// @param light  of a checked receiver
template <class F>
Difference difference(std::span<const Rgb> right, F&& light) {
  double squares = 0, sum = 0, expected = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const Rgb is = light(i), d = is - right[i];
    squares += static_cast<double>(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    sum += static_cast<double>(is.r + is.g + is.b) / 3;
    expected += static_cast<double>(right[i].r + right[i].g + right[i].b) / 3;
  }
  const auto n = static_cast<double>(right.size());
  return {std::sqrt(squares / n) / (expected / n), sum / expected};
}

constexpr uint32_t kPaths = 2048;

void scaling(double largest, const TransferParams& params) {
  fmt::print(
      "| triangles | vertices | detect s | operator s | CPU s | MB | update ms, least | mean | RMSE % | mean "
      "ratio |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double triangles : {1000.0, 3000.0, 10000.0, 30000.0, 100000.0, 300000.0}) {
    if (triangles > largest) break;
    Rig rig(triangles, Rgb(0.6f, 0.2f, 0.1f), params);
    double least = 1e30, used = 0;
    constexpr int kFrames = 20;
    for (int frame = 0; frame < kFrames; ++frame) {
      rig.host.lamps = {lamp_at(0.1f * static_cast<float>(frame))};
      const FrameReport report = rig.radiosity->update();
      least = std::min(least, report.solve_milliseconds), used += report.solve_milliseconds;
    }
    const std::vector<std::size_t> checked = some(rig.receivers.source.count, 256);
    const Difference d =
        difference(path_light(rig.lit(), rig.receivers.source, checked, kPaths),
                   [&](std::size_t i) { return rig.radiosity->ambient()[rig.receivers.places[checked[i]]]; });
    fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.3f} |\n",
               rig.world.size(), rig.radiosity->ambient().size(), rig.detect, rig.wall, rig.seconds,
               static_cast<double>(rig.radiosity->transfer().bytes()) / 1e6, least, used / kFrames,
               100 * d.rmse, d.mean);
    std::fflush(stdout);
  }
}

void keller(double triangles, const TransferParams& params) {
  Rig rig(triangles, Rgb(0.6f, 0.2f, 0.1f), params);
  rig.host.lamps = {lamp_at(1)};
  std::vector<SurfacePoint> points(rig.receivers.source.count);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = rig.receivers.source.footprint(i).sample(Vec2(0.5f));
  const std::vector<std::size_t> checked = some(points.size(), 256);
  const std::vector<Rgb> right = path_light(rig.lit(), rig.receivers.source, checked, 2 * kPaths);
  fmt::print("\n| {} triangles, {} vertices | frame ms | RMSE % | mean ratio |\n|---|---|---|---|\n",
             rig.world.size(), points.size());
  const auto line = [&](const std::string& name, double milliseconds, const Difference& d) {
    fmt::print("| {} | {:.1f} | {:.1f} | {:.3f} |\n", name, milliseconds, 100 * d.rmse, d.mean);
    std::fflush(stdout);
  };
  double used = 0;
  constexpr int kFrames = 20;
  for (int frame = 0; frame < kFrames; ++frame) used += rig.radiosity->update().solve_milliseconds;
  line("operator", used / kFrames, difference(right, [&](std::size_t i) {
         return rig.radiosity->ambient()[rig.receivers.places[checked[i]]];
       }));
  for (const float nearest : {0.0f, 0.5f}) {
    const auto start = Clock::now();
    const std::vector<VirtualLight> samples = light_samples(rig.lit(), 1000);
    const std::vector<Rgb> light = instant_radiosity(rig.tracer, samples, points, nearest);
    line(fmt::format("Keller, {} light samples{}", samples.size(),
                     nearest > 0 ? fmt::format(", none nearer than {} m", nearest) : ""),
         1000 * since(start), difference(right, [&](std::size_t i) { return light[checked[i]]; }));
  }
}

void response(const TransferParams& params) {
  Rig rig(3000, Rgb(0.7f), params);
  rig.host.lamps = {lamp_at(-3)};
  for (int frame = 0; frame < 10; ++frame) rig.radiosity->update();
  rig.host.lamps = {lamp_at(3)};
  const std::vector<std::size_t> checked = some(rig.receivers.source.count, 256);
  const std::vector<Rgb> right = path_light(rig.lit(), rig.receivers.source, checked, 2 * kPaths);
  fmt::print(
      "\n| frame after the lamp's jump, all albedos 0.7 | indirect energy, share of the paths' | of the "
      "tenth frame's |\n"
      "|---|---|---|\n");
  std::vector<double> energy, share;
  for (int frame = 0; frame < 10; ++frame) {
    rig.radiosity->update();
    share.push_back(difference(right, [&](std::size_t i) {
                      return rig.radiosity->ambient()[rig.receivers.places[checked[i]]];
                    }).mean);
    energy.push_back(0);
    for (const Rgb& light : rig.radiosity->ambient()) energy.back() += static_cast<double>(luminance(light));
  }
  for (const std::size_t frame : {0u, 1u, 2u, 9u})
    fmt::print("| {} | {:.3f} | {:.3f} |\n", frame + 1, share[frame], energy[frame] / energy.back());
}

/// A sphere in the middle of the room, or one in a corner, moves by half of its size.
void moving(double triangles, TransferParams params) {
  params.movable = true;
  Scene scene = make_scene(triangles);
  World world = make_world(scene);
  Tracer tracer(scene, world);
  const TracedScene traced{scene, world, tracer};
  const double before = cpu();
  OperatorParts parts(traced, vertex_receivers(traced), params, "", {});
  const Operator op = parts.make({});
  fmt::print("\n| {} triangles | CPU s | rows of {} | clusters fitted again |\n|---|---|---|---|\n",
             world.size(), op.gather.rows);
  fmt::print("| made | {:.1f} | | |\n", cpu() - before);
  for (const auto& [name, sphere] : {std::pair("in the middle", 6u), std::pair("in a corner", 1u)}) {
    scene.instances[sphere].transform[3][1] += 0.5f;
    world = make_world(scene);
    tracer = Tracer(scene, world);
    FollowReport report;
    const double start = cpu();
    parts.follow({}, &report);
    fmt::print("| a sphere {} moved | {:.1f} | {} | {} |\n", name, cpu() - start, report.receivers,
               report.clusters);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 300000;
  TransferParams params;
  params.gather = argc > 2 ? static_cast<std::size_t>(std::atoi(argv[2])) : 16384;
  params.rays = argc > 3 ? std::atoi(argv[3]) : 256;
  params.keep_sums = true;
  scaling(largest, params);
  keller(std::min(largest, 30000.0), params);
  response(params);
  moving(std::min(largest, 30000.0), params);
}
