// SPDX-License-Identifier: Apache-2.0
// Direct light of our own near-field lamps on walls across their nadir, from near to far: the light field by
// eq. 5 and by eq. 14 and the far field of the same rays, against the rays where they land. Markdown to
// standard output.
#include <fmt/format.h>

#include <cmath>

#include "core/parallel.h"
#include "luminaires.h"
#include "measure/field.h"
#include "measure/virtual_bench.h"
#include "scene/groups.h"

namespace {

using namespace sconce;

constexpr uint64_t kRays = 8'000'000;
constexpr int kCells = 20;          // of a wall, along an edge
constexpr double kSurelyLit = 400;  // rays in a cell whose bounds are looked at: 5 % noise
constexpr double kSigmas = 3;
constexpr double kDistances[] = {0.5, 1, 2, 5, 10};

struct Sample {
  const char* name;
  Scene scene;
  double spacing, angle;  ///< m; degrees
};

std::vector<SourceRay> trace(Scene scene) {
  assign_groups(scene, Grouping::automatic);
  const World world = make_world(scene);
  BenchParams params;
  params.rays = kRays;
  return trace_luminaire(scene, world, Tracer(scene, world), Lamps(scene, world), params);
}

struct Cell {
  double landed = 0, hits = 0, squares = 0;  ///< lux; rays; of their flux
  double exact = 0, approximate = 0, far = 0, bound = 0;
};

/// A wall with its cells, centred under the lamp. All in the light field's frame.
class Wall {
 public:
  Wall(double distance, double width) : distance_(distance), width_(width), cells_(kCells * kCells) {}

  void land(std::span<const SourceRay> rays, double plane) {
    const double cell = width_ / kCells;
    for (const SourceRay& ray : rays) {
      if (!(ray.direction.z < 0)) continue;
      const glm::dvec3 p(ray.position), d(ray.direction);
      const glm::dvec2 at =
          (glm::dvec2(p) + glm::dvec2(d) * ((p.z - plane + distance_) / -d.z) + 0.5 * width_) / cell;
      if (!(at.x >= 0 && at.y >= 0 && at.x < kCells && at.y < kCells)) continue;
      Cell& c = cells_[static_cast<std::size_t>(at.y) * kCells + static_cast<std::size_t>(at.x)];
      const double lux = static_cast<double>(ray.flux) / (cell * cell);
      c.landed += lux, c.squares += lux * lux, c.hits += 1;
    }
  }

  void light(const NearLamp& lamp, const Photometry& far) {
    constexpr int kPoints = 4;  // along an edge of a cell
    parallel_for(cells_.size(), 1, [&](std::size_t i) {
      Cell& c = cells_[i];
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const glm::dvec2 in = (glm::dvec2(k % kPoints, k / kPoints) + 0.5) / static_cast<double>(kPoints);
        const glm::dvec2 at = (glm::dvec2(i % kCells, i / kCells) + in) * (width_ / kCells) - 0.5 * width_;
        const Vec3 x(Vec2(at), static_cast<float>(-distance_)), up(0, 0, 1);
        const double share = 1.0 / (kPoints * kPoints), d = static_cast<double>(glm::length(x));
        c.exact += share * lamp.exact(x, up, 4);
        const double approximate = lamp.approximate(x, up);
        c.approximate += share * approximate;
        c.bound += share * lamp.bound(x, up) * std::abs(approximate);
        c.far += share * intensity(far, glm::normalize(x)) * distance_ / (d * d * d);
      }
    });
  }

  void print(double times) const {
    double truth2 = 0, noise2 = 0, exact2 = 0, near2 = 0, far2 = 0;
    double truth = 0, bound = 0, lit = 0, of_exact = 0, of_rays = 0;
    for (const Cell& c : cells_) {
      truth2 += c.landed * c.landed, noise2 += c.squares;
      exact2 += std::pow(c.exact - c.landed, 2), near2 += std::pow(c.approximate - c.landed, 2);
      far2 += std::pow(c.far - c.landed, 2);
      if (c.hits < kSurelyLit) continue;
      lit += 1, truth += c.landed, bound += c.bound;
      of_exact += std::abs(c.approximate - c.exact) <= c.bound;
      of_rays += std::abs(c.approximate - c.landed) <= c.bound + kSigmas * std::sqrt(c.squares);
    }
    const auto share = [&](double v) { return 100 * std::sqrt(v / truth2); };
    fmt::print(
        "| {} | {:.2f} | {:.1f} % | {:.1f} % | {:.0f} % | {:.0f} % | {:.1f} % | {:.1f} % of {} "
        "|\n",
        times, share(noise2), share(exact2), share(near2), share(far2), 100 * bound / truth,
        100 * of_exact / lit, 100 * of_rays / lit, lit);
  }

 private:
  double distance_, width_;
  std::vector<Cell> cells_;
};

void report(const Sample& lamp) {
  const std::vector<SourceRay> rays = trace(lamp.scene);
  FieldParams params;
  params.basis = NearBasis::bell;
  params.spacing = lamp.spacing;
  params.angle = lamp.angle;
  const MeasuredField measured = measure_field([&](const auto& f) { f(rays); }, params, lamp.name);
  FarFieldBins bins(72, 180);
  bins.add(rays);
  const Photometry far = bins.table();
  const LightField& field = measured.field;
  // What the filters' grid has room for is the opening, but for a filter's half.
  const double size = field.spacing * (std::max(field.columns, field.rows) - 3);
  fmt::print("\n{}: {} x {} filters of {:g} mm, {} x {} pixels, {:.1f} lm; opening {:.0f} mm\n\n", lamp.name,
             field.columns, field.rows, 1e3 * field.spacing, field.width, field.height, measured.kept,
             1e3 * size);
  fmt::print(
      "| distance ÷ size | rays' noise, % | eq. 5 | eq. 14 | far field | bound | covers eq. 5 | "
      "covers rays |\n|---|---|---|---|---|---|---|---|\n");
  const NearLamp near(field);
  for (const double times : kDistances) {
    const double distance = times * size;
    Wall wall(distance, size + 1.2 * distance * std::tan(lamp.angle * 3.14159265 / 180));
    wall.land(rays, measured.plane);
    wall.light(near, far);
    wall.print(times);
  }
}

}  // namespace

int main() {
  fmt::print(
      "# Near-field lamps against their own rays\n\n"
      "`near_field`: relative RMSE of direct light on a wall of {0} x {0} cells across nadir. Truth is where "
      "{1} "
      "M rays of the\nvirtual bench land; their own noise is in all columns. *Bound*: the error of eq. 14 "
      "that "
      "`NearLamp::bound` predicts, as a share of the light.\n*Covers eq. 5*: cells with {2:g} rays and more "
      "where "
      "eq. 14 is no further from eq. 5 than that. *Covers rays*: those where it is no further from\nthe rays "
      "than that and {3:g} times their noise.\n",
      kCells, kRays / 1'000'000, kSurelyLit, kSigmas);
  using namespace demo;
  for (const Sample& lamp :
       {Sample{"Torch", make_torch(), 0.01, 30}, Sample{"Torch", make_torch(), 0.005, 30},
        Sample{"Bicycle light", make_bicycle_light(), 0.0075, 40}, Sample{"Louvre", make_louvre(), 0.02, 55}})
    report(lamp);
  return 0;
}
