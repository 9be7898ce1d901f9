// SPDX-License-Identifier: Apache-2.0
// How far indirect light by transfer is from the path tracer's, for lamps at random places: relative error
// over receivers, of indirect light alone. Usage: transfer_error PACKAGE OPERATOR [LAMPS RECEIVERS PATHS
// SEED]. The table: bench/results/transfer.md.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/parallel.h"
#include "core/sobol.h"
#include "relight/moved_lamps.h"
#include "relight/receivers.h"
#include "solve/solver.h"
#include "transfer/folded_bounces.h"

using namespace sconce;

namespace {

/// Lamps in free space that is seen: between a random receiver and the camera, or along a random ray; every
/// other one a spot.
std::vector<Light> random_lamps(const View& view, const Operator& op, int count, uint32_t seed) {
  std::vector<Light> lamps;
  // By places, whatever the operator's own order is.
  std::vector<std::pair<uint32_t, uint32_t>> by_place;
  for (uint32_t i = 0; i < op.places.size(); ++i) by_place.emplace_back(op.places[i], i);
  std::sort(by_place.begin(), by_place.end());
  for (uint32_t i = 0; static_cast<int>(lamps.size()) < count && i < 10000; ++i) {
    Sampler sampler(seed, 0x6c616d70u, i);
    const Vec2 pick = sampler.next(), along = sampler.next(), aim = sampler.next(), shape = sampler.next();
    const auto& r =
        op.receivers[by_place[static_cast<std::size_t>(pick.x * static_cast<float>(by_place.size()))].second];
    const Vec3 from(r.position[0], r.position[1], r.position[2]), n = unpack_normal(r.geometric);
    Vec3 direction = Frame(n).to_world(square_to_cosine(along));
    float distance = view.tracer().closest({offset_origin(from, n, direction), direction}).distance;
    if (op.kind == OperatorReceivers::pixels) {
      const Vec3 to_eye = Vec3(op.camera_frame[3]) - from;
      distance = glm::length(to_eye), direction = to_eye / distance;
    }
    if (distance < 0.05f * view.world().bounds.diagonal()) continue;
    Light light;
    light.name = light.group_name = fmt::format("lamp {}", lamps.size());
    light.intensity = Rgb(100);
    const Vec3 at = from + (0.2f + 0.6f * pick.y) * distance * direction;
    const Vec3 z = -Frame(direction).to_world(square_to_cosine(aim));
    const Frame frame(z);
    light.frame = Mat4(glm::vec4(frame.x, 0), glm::vec4(frame.y, 0), glm::vec4(z, 0), glm::vec4(at, 1));
    if (lamps.size() % 2 == 1) {
      SpotLight spot;
      spot.outer = 0.35f + 0.45f * shape.x, spot.inner = 0.8f * spot.outer;
      light.shape = spot;
    }
    lamps.push_back(std::move(light));
  }
  return lamps;
}

struct Errors {
  double mean = 0, rmse = 0, worst = 0;
  int lamps = 0;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What leaving small coefficients out costs and saves: means over lamps, of F's product alone.
class CullingTable {
 public:
  explicit CullingTable(const ClusterRows& gather) : gather_(gather), culling_(gather) {}

  /// @param light  coefficients, after all bounces
  void add(const std::vector<Rgbx>& light) {
    ++lamps_;
    std::vector<Rgb> whole(gather_.rows), part(gather_.rows);
    whole_ms_ += fastest([&] { multiply(gather_, light, whole); });
    double norm = 0;
    for (const Rgb& e : whole) norm += square(e);
    for (Row& row : rows_) {
      std::vector<Rgbx> left;
      Culling::Report report;
      // Finding them is paid for each time.
      row.ms += fastest([&] {
        left = light;
        report = culling_.apply(row.share, left);
        multiply(gather_, left, part, Zeros::skip);
      });
      double squares = 0;
      for (std::size_t i = 0; i < part.size(); ++i) squares += square(part[i] - whole[i]);
      row.kept += 1 - static_cast<double>(report.culled) / static_cast<double>(report.of);
      row.error += std::sqrt(squares / norm), row.bound += report.bound / std::sqrt(norm);
    }
  }
  void print() const {
    fmt::print("F's product, nothing culled: {:.2f} ms\n", whole_ms_ / lamps_);
    for (const Row& row : rows_)
      fmt::print("culled below {:<6}: {:4.1f} % kept, error {:.3f} %, bound {:.1f} %, {:.2f} ms, {:.2f} x\n",
                 row.share, 100 * row.kept / lamps_, 100 * row.error / lamps_, 100 * row.bound / lamps_,
                 row.ms / lamps_, whole_ms_ / row.ms);
  }

 private:
  struct Row {
    float share;
    double kept = 0, error = 0, bound = 0, ms = 0;
  };
  static double square(const Rgb& e) { return static_cast<double>(e.r * e.r + e.g * e.g + e.b * e.b); }
  template <class F>
  static double fastest(const F& f) {
    double least = 1e30;
    for (int repeat = 0; repeat < 10; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      f();
      least = std::min(least, milliseconds_since(start));
    }
    return least;
  }

  const ClusterRows& gather_;
  Culling culling_;
  double whole_ms_ = 0;
  int lamps_ = 0;
  std::array<Row, 4> rows_{{{1e-4f}, {3e-4f}, {1e-3f}, {3e-3f}}};
};

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  const Package package = Package::open(argv[1]);
  const View view(package);
  const Operator op = open_operator(argv[2]);
  const std::vector<Light> lamps = random_lamps(view, op, number(3, 20), static_cast<uint32_t>(number(6, 1)));

  // Every lamp is a group of one scene, so that one set of paths serves all.
  Scene scene = view.scene();
  scene.lights = lamps;
  scene.groups.clear();
  for (Material& material : scene.materials) material.emission = Rgb(0);
  for (Light& light : scene.lights) {
    light.group = Id<LightGroup>(scene.groups.size());
    scene.groups.push_back({light.name});
  }
  const Lamps all(scene, view.world());
  BakeParams params;
  params.samples = number(5, 2048);
  const auto solver = find_solver("path").prepare({scene, view.world(), view.tracer(), all}, params, {});
  const auto count = static_cast<std::size_t>(number(4, 400));
  const std::size_t groups = lamps.size();
  std::vector<std::size_t> picked(count);
  std::vector<GroupValue> truth(count * groups);
  const auto point = [&](std::size_t i) {
    const OperatorPoint& p = op.receivers[i];
    return SurfacePoint{Vec3(p.position[0], p.position[1], p.position[2]), unpack_normal(p.shading),
                        unpack_normal(p.geometric)};
  };
  parallel_for(count, 1, [&](std::size_t k) {
    picked[k] = static_cast<std::size_t>(static_cast<double>(k) / static_cast<double>(count) *
                                         static_cast<double>(op.receivers.size()));
    solver->solve(Footprint::point(static_cast<uint32_t>(k), ReceiverKind::texel, point(picked[k])),
                  std::span(truth).subspan(k * groups, groups));
  });

  const FoldedBounces bounces(op);
  CullingTable culling(op.gather);
  std::vector<Rgb> indirect(op.gather.rows);
  Errors by_kind[2];
  for (std::size_t g = 0; g < groups; ++g) {
    const MovedLamps moved(view.scene(), view.world(), view.tracer(), {lamps[g]}, {});
    const auto start = std::chrono::steady_clock::now();
    std::vector<Rgbx> light = light_cloud(op, moved);
    const auto lit = std::chrono::steady_clock::now();
    bounces.apply(light);
    multiply(op.gather, light, indirect);
    const double took = milliseconds_since(lit), cloud = milliseconds_since(start) - took;
    culling.add(light);
    double sum = 0, expected = 0, squares = 0, noise = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const GroupValue& value = truth[k * groups + g];
      const Rgb direct = moved.illuminance(point(picked[k]), 0, 0);
      const auto want = static_cast<double>(luminance(value.illuminance - direct)),
                 have = static_cast<double>(luminance(indirect[picked[k]]));
      sum += have, expected += want;
      squares += (have - want) * (have - want);
      noise += static_cast<double>(value.error) * static_cast<double>(value.error);
    }
    const auto n = static_cast<double>(count);
    const double rmse = std::sqrt(std::max(0.0, squares - noise) / n) / (expected / n);
    Errors& errors = by_kind[g % 2];
    errors.mean += sum / expected, errors.rmse += rmse, errors.worst = std::max(errors.worst, rmse);
    ++errors.lamps;
    fmt::print(
        "{:6} {:2}: mean {:.3f}, relative RMSE {:5.1f} %, noise taken off {:.1f} %, cloud {:.0f} ms, "
        "indirect {:.1f} ms\n",
        g % 2 == 0 ? "point" : "spot", g, sum / expected, 100 * rmse,
        100 * std::sqrt(noise / n) / (expected / n), cloud, took);
  }
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    double least = 1e30;
    for (int repeat = 0; repeat < 30; ++repeat) {
      std::vector<Rgbx> light(op.slots(), Rgbx{1, 1, 1, 0});
      const auto start = std::chrono::steady_clock::now();
      bounces.apply(light);
      multiply(op.gather, light, indirect);
      least = std::min(least, milliseconds_since(start));
    }
    fmt::print("{} thread(s): light to light {:.2f} ms, the least of 30\n", threads, least);
  }
  culling.print();
  fmt::print("\n{}: {} receivers, {} slots, {:.1f} MB, {:.0f} multiplications per receiver, {} sweeps\n",
             argv[1], op.gather.rows, op.slots(), static_cast<double>(op.bytes()) / 1e6,
             op.gather.macs_per_row(), op.sweeps);
  for (int kind = 0; kind < 2; ++kind) {
    const Errors& e = by_kind[kind];
    fmt::print("{:6} mean {:.3f}, relative RMSE {:.1f} %, worst {:.1f} %\n", kind == 0 ? "point" : "spot",
               e.mean / e.lamps, 100 * e.rmse / e.lamps, 100 * e.worst);
  }
  return 0;
}
