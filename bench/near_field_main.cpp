// SPDX-License-Identifier: Apache-2.0
// Direct light of our own near-field lamps on walls across their nadir, from near to far: the light field by
// eq. 5 and by eq. 14 and the far field of the same rays, against the rays where they land. Markdown to
// standard output.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

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
  double exact = 0, approximate = 0, far = 0;
  double frozen = 0, noise = 0;      ///< predicted, lux
  std::array<double, 12> departs{};  ///< signed, per neighbour, lux

  double bound() const {
    double most = 0;
    for (const double d : departs) most = std::max(most, std::abs(d));
    return frozen + NearLamp::kDetail * most;
  }
};

/// A wall with its cells, centred under the lamp. All in the light field's frame.
class Wall {
 public:
  Wall(double distance, double width) : distance_(distance), width_(width), cells_(kCells * kCells) {}

  /// What the light field leaves out, its wall lacks too. @param tangent  of the field's angle from nadir
  void land(std::span<const SourceRay> rays, double plane, double tangent) {
    const double cell = width_ / kCells;
    for (const SourceRay& ray : rays) {
      const glm::dvec3 p(ray.position), d(ray.direction);
      if (!(d.z < 0) || glm::length(glm::dvec2(d)) > tangent * -d.z) continue;
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
        c.frozen += share * lamp.bound(x, up) * std::abs(approximate);
        c.noise += share * lamp.noise(x, up, width_ / kCells);
        const std::array<Vec3, 12> neighbours = lamp.neighbours(x);
        for (std::size_t j = 0; j < neighbours.size(); ++j)
          c.departs[j] +=
              share *
              (0.5 * (lamp.approximate(x + neighbours[j], up) + lamp.approximate(x - neighbours[j], up)) -
               approximate);
        c.far += share * intensity(far, glm::normalize(x)) * distance_ / (d * d * d);
      }
    });
  }

  void print(double times) const {
    double truth2 = 0, noise2 = 0, exact2 = 0, near2 = 0, far2 = 0;
    double truth = 0, frozen = 0, bound = 0, noise = 0, error = 0, lit = 0, of_exact = 0, of_rays = 0;
    for (const Cell& c : cells_) {
      truth2 += c.landed * c.landed, noise2 += c.squares;
      exact2 += std::pow(c.exact - c.landed, 2), near2 += std::pow(c.approximate - c.landed, 2);
      far2 += std::pow(c.far - c.landed, 2);
      if (c.hits < kSurelyLit) continue;
      lit += 1, truth += c.landed, frozen += c.frozen, bound += c.bound(), noise += c.noise;
      error += std::abs(c.approximate - c.landed);
      of_exact += std::abs(c.approximate - c.exact) <= c.bound();
      of_rays += std::abs(c.approximate - c.landed) <=
                 c.bound() + kSigmas * std::sqrt(c.squares + c.noise * c.noise);
    }
    const auto share = [&](double v) { return 100 * std::sqrt(v / truth2); };
    fmt::print(
        "| {} | {:.2f} | {:.1f} % | {:.1f} % | {:.0f} % | {:.1f} % | {:.0f} % | {:.1f} % | {:.1f} | {:.1f} % "
        "| "
        "{:.1f} % of {} |\n",
        times, share(noise2), share(exact2), share(near2), share(far2), 100 * frozen / truth,
        100 * (bound - frozen) / truth, 100 * noise / truth, bound / error, 100 * of_exact / lit,
        100 * of_rays / lit, lit);
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
      "| distance ÷ size | rays' noise, % | eq. 5 | eq. 14 | far field | geometry | detail | noise | ÷ error "
      "| "
      "covers eq. 5 | covers rays |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const NearLamp near(field);
  const double tangent = std::tan(lamp.angle * std::numbers::pi / 180);
  for (const double times : kDistances) {
    const double distance = times * size;
    Wall wall(distance, size + 1.2 * distance * tangent);
    wall.land(rays, measured.plane, tangent);
    wall.light(near, far);
    wall.print(times);
  }
}

}  // namespace

int main() {
  fmt::print(
      "# Near-field lamps against their own rays\n\n"
      "`near_field`: relative RMSE of direct light on a wall of {0} x {0} cells across nadir. Truth is where "
      "{1} M rays of the\nvirtual bench land, those within the field's angle from nadir; their own noise is "
      "in "
      "all columns. Predicted, as shares of the light:\n*geometry*, what eq. 14 freezes of it "
      "(`NearLamp::bound`); *detail*, what filters and pixels blur (`detail`); *noise* of the light field "
      "(`noise`),\none sigma. *÷ error*: the first two over the true error of eq. 14, means. *Covers eq. 5*: "
      "cells with {2:g} rays and more where eq. 14 is no\nfurther from eq. 5 than these two. *Covers rays*: "
      "those where it is no further from the rays than these and {3:g} times the noise of both.\nThe factor "
      "of "
      "*detail* was set with the torch, the bicycle light and the louvre "
      "(docs/adr/0039-near-field-errors.md); "
      "the washer had no part in it.\n",
      kCells, kRays / 1'000'000, kSurelyLit, kSigmas);
  using namespace demo;
  for (const Sample& lamp :
       {Sample{"Torch", make_torch(), 0.01, 30}, Sample{"Torch", make_torch(), 0.005, 30},
        Sample{"Bicycle light", make_bicycle_light(), 0.0075, 40}, Sample{"Louvre", make_louvre(), 0.02, 55},
        Sample{"Washer", make_washer(), 0.01, 50}})
    report(lamp);
  return 0;
}
