// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asked.h"
#include "photometry/photometry.h"
#include "rows.h"

namespace sconce::validation {

namespace {

/// I cos(gamma) in steps of a degree, cd.
Photometry lambertian(double candela, double step) {
  Photometry p;
  p.azimuths = {0, 360};
  for (int i = 0; i * step <= 90 + 1e-9; ++i) p.polars.push_back(i * step);
  for (int side = 0; side < 2; ++side)
    for (const double g : p.polars) p.candela.push_back(candela * std::max(0.0, std::cos(g * kPiD / 180)));
  return p;
}

/// A lamp that hangs at the origin, and below it whatever is asked.
Asked hung(const Photometry& p) {
  Scene scene;
  add_quad(scene, "floor", black(scene), Vec3(-9, -9, -9), Vec3(0, 0, 18), Vec3(18, 0, 0));
  hang(scene, p);
  return Asked(std::move(scene));
}

}  // namespace

Section measured_lamps(const std::filesystem::path&) {
  Section out{"Measured lamps", "Tables with known flux and light (analytic tests 9, 12 and 13).", {}};
  const auto add = [&](std::string what, double reference, double ours, double allowed) {
    out.rows.push_back({std::move(what), reference, ours, allowed});
  };
  Photometry one;
  one.azimuths = {0, 360}, one.polars = {0, 45, 180}, one.candela.assign(6, 1);
  add("1 cd all around, lm", 4 * kPiD, flux(one), 1e-12);
  // The factors by which a piecewise linear cosine falls short of pi I0 (methods.md 2.7).
  for (const auto& [step, loss] :
       {std::pair(1.0, 2.5e-5), std::pair(2.5, 1.6e-4), std::pair(5.0, 6.4e-4), std::pair(10.0, 2.5e-3)})
    add(fmt::format("Lambert, 100 cd, every {:g} degrees, lm", step), kPiD * 100 * (1 - loss),
        flux(lambertian(100, step)), 0.1 * loss);
  Photometry disk = lambertian(50 * kPiD * 0.5625, 0.25);  // 50 cd/m2
  disk.opening = {Opening::Shape::cylinder, 2, Vec3(1.5f, 1.5f, 0)};
  const Asked round = hung(disk);
  for (const double r : {0.0, 1.5}) {
    const double s = 4 + r * r + 0.5625;
    add(fmt::format("Lambertian disk of 0.75 m and 50 cd/m² as a luminaire, 2 m below, {:g} m aside, lx", r),
        kPiD * 25 * (1 - (4 + r * r - 0.5625) / std::sqrt(s * s - 2.25 * r * r)),
        round.lux(Vec3(static_cast<float>(r), -2, 0), Vec3(0, 1, 0)), 0.005);
  }
  Photometry panel = lambertian(40 * 0.5, 0.25);  // 40 cd/m2
  panel.opening = {Opening::Shape::box, 2, Vec3(1, 0.5f, 0)};
  add("Lambertian panel 1 x 0.5 m, 40 cd/m², 1 m below its centre, lx",
      polygon_lux(rectangle({-0.5, 0, -0.25}, {1, 0, 0}, {0, 0, 0.5}), 40, {0, -1, 0}, {0, 1, 0}),
      hung(panel).lux(Vec3(0, -1, 0), Vec3(0, 1, 0)), 0.005);
  const Asked point = hung(lambertian(100, 0.25));
  for (const double x : {0.0, 2.0})
    add(fmt::format("Lambertian point of 100 cd, 3 m below, {:g} m aside, lx", x),
        100 * 9 / std::pow(9 + x * x, 2), point.lux(Vec3(static_cast<float>(x), -3, 0), Vec3(0, 1, 0)), 1e-5);
  return out;
}

}  // namespace sconce::validation
