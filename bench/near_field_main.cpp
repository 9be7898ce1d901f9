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
#include "photometry/near_error.h"
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
  NearBasis basis = NearBasis::bell;
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
  double predicted = 0, noise = 0;  ///< lux
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

  void light(const NearLamp& lamp, const NearError& error, const Photometry& far) {
    constexpr int kPoints = 4;  // along an edge of a cell
    parallel_for(cells_.size(), 1, [&](std::size_t i) {
      Cell& c = cells_[i];
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const glm::dvec2 in = (glm::dvec2(k % kPoints, k / kPoints) + 0.5) / static_cast<double>(kPoints);
        const glm::dvec2 at = (glm::dvec2(i % kCells, i / kCells) + in) * (width_ / kCells) - 0.5 * width_;
        const Vec3 x(Vec2(at), static_cast<float>(-distance_)), up(0, 0, 1);
        const double share = 1.0 / (kPoints * kPoints), d = static_cast<double>(glm::length(x));
        c.exact += share * lamp.exact(x, up, 4);
        c.approximate += share * lamp.approximate(x, up);
        c.predicted += share * error.at(x, up);
        c.noise += share * lamp.noise(x, up, width_ / kCells);
        c.far += share * intensity(far, glm::normalize(x)) * distance_ / (d * d * d);
      }
    });
  }

  void print(double times) const {
    double truth2 = 0, noise2 = 0, exact2 = 0, near2 = 0, far2 = 0;
    double truth = 0, predicted = 0, noise = 0, error = 0, lit = 0, of_exact = 0, of_rays = 0;
    for (const Cell& c : cells_) {
      truth2 += c.landed * c.landed, noise2 += c.squares;
      exact2 += std::pow(c.exact - c.landed, 2), near2 += std::pow(c.approximate - c.landed, 2);
      far2 += std::pow(c.far - c.landed, 2);
      if (c.hits < kSurelyLit) continue;
      lit += 1, truth += c.landed, predicted += c.predicted, noise += c.noise;
      error += std::abs(c.approximate - c.landed);
      of_exact += std::abs(c.approximate - c.exact) <= c.predicted;
      of_rays += std::abs(c.approximate - c.landed) <=
                 c.predicted + kSigmas * std::sqrt(c.squares + c.noise * c.noise);
    }
    const auto share = [&](double v) { return 100 * std::sqrt(v / truth2); };
    fmt::print(
        "| {} | {:.2f} | {:.1f} % | {:.1f} % | {:.0f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} | {:.1f} % "
        "| {:.1f} % of {} |\n",
        times, share(noise2), share(exact2), share(near2), share(far2), 100 * error / truth,
        100 * predicted / truth, 100 * noise / truth, predicted / error, 100 * of_exact / lit,
        100 * of_rays / lit, lit);
  }

 private:
  double distance_, width_;
  std::vector<Cell> cells_;
};

void report(const Sample& lamp) {
  const std::vector<SourceRay> rays = trace(lamp.scene);
  FieldParams params;
  params.basis = lamp.basis;
  params.spacing = lamp.spacing;
  params.angle = lamp.angle;
  const MeasuredField measured = measure_field([&](const auto& f) { f(rays); }, params, lamp.name);
  FarFieldBins bins(72, 180);
  bins.add(rays);
  const Photometry far = bins.table();
  const LightField& field = measured.field;
  const glm::dvec2 extent = opening(field);
  const double size = std::max(extent.x, extent.y);
  fmt::print("\n{}: {} x {} {}s of {:g} mm, {} x {} pixels, {:.1f} lm; opening {:.0f} mm\n\n", lamp.name,
             field.columns, field.rows, name_of(field.basis), 1e3 * field.spacing, field.width, field.height,
             measured.kept, 1e3 * size);
  fmt::print(
      "| distance ÷ size | rays' noise, % | eq. 5 | eq. 14 | far field | error | predicted | noise | ÷ error "
      "| covers eq. 5 | covers rays |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const NearLamp near(field);
  const NearError error(near);
  const double tangent = std::tan(lamp.angle * std::numbers::pi / 180);
  for (const double times : kDistances) {
    const double distance = times * size;
    Wall wall(distance, size + 1.2 * distance * tangent);
    wall.land(rays, measured.plane, tangent);
    wall.light(near, error, far);
    wall.print(times);
  }
}

}  // namespace

int main() {
  fmt::print(
      "# Near-field lamps against their own rays\n\n"
      "`near_field`: relative RMSE of direct light on a wall of {0} x {0} cells across nadir. Truth is where "
      "{1} M rays of the\nvirtual bench land, those within the field's angle from nadir; their own noise is "
      "in all columns. *Error*: of eq. 14, mean of |difference|, as a share of the light; *predicted*: "
      "`NearError`, how much filters twice as wide\nchange; *noise* of the light field "
      "(`NearLamp::noise`), one sigma. *÷ error*: predicted over error. *Covers eq. 5*: cells with {2:g} "
      "rays\nand more where eq. 14 is no further from eq. 5 than predicted. *Covers rays*: those where it is "
      "no further from the rays than that and {3:g} times\nthe noise of both. The factor of the prediction "
      "was set with the torch, the bicycle light and the louvre "
      "(docs/adr/0039-near-field-errors.md); the\nwasher and the splines had no part in it.\n",
      kCells, kRays / 1'000'000, kSurelyLit, kSigmas);
  using namespace demo;
  for (const Sample& lamp :
       {Sample{"Torch", make_torch(), 0.01, 30}, Sample{"Torch", make_torch(), 0.005, 30},
        Sample{"Bicycle light", make_bicycle_light(), 0.0075, 40}, Sample{"Louvre", make_louvre(), 0.02, 55},
        Sample{"Washer", make_washer(), 0.01, 50},
        Sample{"Torch", make_torch(), 0.005, 30, NearBasis::spline},
        Sample{"Washer", make_washer(), 0.01, 50, NearBasis::spline}})
    report(lamp);
  return 0;
}
