// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "photometry/rays.h"

namespace sconce {

FarFieldBins::FarFieldBins(int planes, int zones)
    : planes_(planes),
      zones_(zones),
      bins_(static_cast<std::size_t>(planes) * static_cast<std::size_t>(zones + 1)) {}

void FarFieldBins::add(std::span<const SourceRay> rays) {
  for (const SourceRay& ray : rays) {
    const auto [c, gamma] = angles_of(Photometry::Type::c, ray.direction);
    const auto plane = static_cast<std::size_t>(std::lround(c / 360 * planes_) % planes_);
    const auto zone = static_cast<std::size_t>(std::lround(gamma / 180 * zones_));
    const auto flux = static_cast<double>(ray.flux);
    bins_[plane * static_cast<std::size_t>(zones_ + 1) + zone] += flux;
    flux_ += flux;
  }
}

Photometry FarFieldBins::table() const {
  Photometry out;
  out.format = "rays";
  out.absolute = true;
  out.lamps = {LampSet{}};
  const auto zones = static_cast<std::size_t>(zones_) + 1, planes = static_cast<std::size_t>(planes_);
  for (std::size_t g = 0; g < zones; ++g) out.polars.push_back(180.0 * static_cast<double>(g) / zones_);
  const auto solid_angle = [&](std::size_t g) {
    const double half = 0.5 * std::numbers::pi / zones_, at = static_cast<double>(g) * 2 * half;
    return 2 * std::numbers::pi / planes_ *
           (std::cos(std::max(0.0, at - half)) - std::cos(std::min(std::numbers::pi, at + half)));
  };
  out.candela.resize((planes + 1) * zones);
  for (std::size_t a = 0; a <= planes; ++a) out.azimuths.push_back(360.0 * static_cast<double>(a) / planes_);
  for (std::size_t g = 0; g < zones; ++g) {
    const auto bin = [&](std::size_t a) { return bins_[a % planes * zones + g]; };
    // Towards the poles planes crowd: there the mean over as much of a ring as a zone is wide, at a pole,
    // which is one direction, over all of it.
    const double crowded =
                     planes_ / (2.0 * zones_ * std::sin(std::numbers::pi * static_cast<double>(g) / zones_)),
                 window = g == 0 || g + 1 == zones ? planes_ : std::clamp(crowded, 1.0, 1.0 * planes_);
    const auto whole = static_cast<std::size_t>(0.5 * (window - 1));  // bins on either side
    const double part = 0.5 * (window - 1) - static_cast<double>(whole);
    for (std::size_t a = 0; a <= planes; ++a) {
      double flux = bin(a) + part * (bin(a + whole + 1) + bin(a + planes - whole - 1));
      for (std::size_t i = 1; i <= whole; ++i) flux += bin(a + i) + bin(a + planes - i);
      out.candela[a * zones + g] = flux / window / solid_angle(g);
    }
  }
  const double scale = flux_ / sconce::flux(out);
  for (double& v : out.candela) v *= scale;
  return out;
}

}  // namespace sconce
