// SPDX-License-Identifier: Apache-2.0
#include "photometry/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sconce {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Intensity in the plane through C and C + 180 at a signed angle from nadir, degrees in [-180, 180].
double in_plane(const Photometry& p, double c, double angle) {
  return intensity_at(p, std::fmod(angle < 0 ? c + 180 : c, 360), std::abs(angle));
}

}  // namespace

Peak peak_of(const Photometry& p) {
  Peak peak;
  for (std::size_t a = 0; a < p.azimuths.size(); ++a)
    for (std::size_t g = 0; g < p.polars.size(); ++g)
      if (p.at(a, g) > peak.candela) peak = {p.at(a, g), p.azimuths[a], p.polars[g]};
  return peak;
}

double beam_angle(const Photometry& p, double c, double fraction) {
  constexpr double kStep = 0.1;
  double top = 0, most = -1;
  for (int i = -1800; i <= 1800; ++i) {
    const double v = in_plane(p, c, i * kStep);
    // Of equal peaks, the one nearest to nadir.
    if (v > most * (1 + 1e-9) || (v >= most * (1 - 1e-9) && std::abs(i * kStep) < std::abs(top)))
      most = v, top = i * kStep;
  }
  if (!(most > 0)) return 0;
  const auto reach = [&](double sign) {
    double angle = top;
    while (std::abs(angle + sign * kStep) <= 180 && in_plane(p, c, angle + sign * kStep) > fraction * most)
      angle += sign * kStep;
    return angle;
  };
  return reach(1) - reach(-1);
}

std::array<double, 10> direct_ratios(const Photometry& p) {
  std::array<double, 10> out{};
  double all = 0;
  constexpr int kZones = 180, kPlanes = 144;
  for (int z = 0; z < kZones; ++z) {
    const double gamma = (z + 0.5) * 90 / kZones;
    for (int c = 0; c < kPlanes; ++c) {
      const double azimuth = (c + 0.5) * 360 / kPlanes;
      const double part = intensity_at(p, azimuth, gamma) * std::sin(gamma * kDegree);
      all += part;
      // A ray drifts by h tan(gamma) across a room of side 2 k h; what passes a wall is lost.
      for (std::size_t k = 0; k < out.size(); ++k) {
        const double drift = std::tan(gamma * kDegree) / (2 * kRoomIndices[k]);
        out[k] += part * std::max(0.0, 1 - drift * std::abs(std::cos(azimuth * kDegree))) *
                  std::max(0.0, 1 - drift * std::abs(std::sin(azimuth * kDegree)));
      }
    }
  }
  for (double& v : out) v = all > 0 ? v / all : 0;
  return out;
}

}  // namespace sconce
