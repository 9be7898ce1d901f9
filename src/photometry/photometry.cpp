// SPDX-License-Identifier: Apache-2.0
#include "photometry/photometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sconce {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPastHorizon = 0.01;  // degrees

/// Interval of an ascending list that holds v, and where in it; nothing outside.
struct Place {
  std::size_t low;
  double weight;  ///< of low + 1
};
std::optional<Place> place_in(const std::vector<double>& angles, double v) {
  // Rounding of an acos must not cut off the pole.
  constexpr double kSlack = 1e-4;
  if (v < angles.front() - kSlack || v > angles.back() + kSlack) return std::nullopt;
  if (angles.size() == 1) return Place{0, 0};
  const auto above = std::upper_bound(angles.begin(), angles.end(), v);
  const auto low = std::clamp<std::ptrdiff_t>(above - angles.begin() - 1, 0,
                                              static_cast<std::ptrdiff_t>(angles.size()) - 2);
  const auto i = static_cast<std::size_t>(low);
  return Place{i, std::clamp((v - angles[i]) / (angles[i + 1] - angles[i]), 0.0, 1.0)};
}

bool same_column(const Photometry& p, std::size_t a, std::size_t b) {
  const auto from = p.candela.begin();
  const auto n = static_cast<std::ptrdiff_t>(p.polars.size());
  return std::equal(from + static_cast<std::ptrdiff_t>(a) * n, from + static_cast<std::ptrdiff_t>(a + 1) * n,
                    from + static_cast<std::ptrdiff_t>(b) * n);
}

/// Is every plane that of its mirror image, where mirror(C) gives its angle in [0, 360]?
template <class Mirror>
bool mirrored(const Photometry& p, const Mirror& mirror) {
  for (std::size_t i = 0; i < p.azimuths.size(); ++i) {
    const auto found = std::lower_bound(p.azimuths.begin(), p.azimuths.end(), mirror(p.azimuths[i]) - 1e-9);
    if (found == p.azimuths.end() || *found > mirror(p.azimuths[i]) + 1e-9) return false;
    if (!same_column(p, i, static_cast<std::size_t>(found - p.azimuths.begin()))) return false;
  }
  return true;
}

/// Flux of the table between two polar angles, lm.
double flux_between(const Photometry& p, double from, double to) {
  double sum = 0;
  for (std::size_t a = 0; a + 1 < p.azimuths.size(); ++a) {
    double plane = 0;
    for (std::size_t g = 0; g + 1 < p.polars.size(); ++g) {
      const double g0 = std::max(from, p.polars[g]), g1 = std::min(to, p.polars[g + 1]);
      if (g0 >= g1) continue;
      const double i0 = 0.5 * (p.at(a, g) + p.at(a + 1, g)), i1 = 0.5 * (p.at(a, g + 1) + p.at(a + 1, g + 1));
      const double slope = (i1 - i0) / (p.polars[g + 1] - p.polars[g]);
      plane += zone_integral(g0, g1, i0 + slope * (g0 - p.polars[g]), i0 + slope * (g1 - p.polars[g]));
    }
    sum += plane * (p.azimuths[a + 1] - p.azimuths[a]) * kDegree;
  }
  return sum;
}

}  // namespace

std::string Photometry::keyword(std::string_view name) const {
  for (const auto& [key, value] : keywords)
    if (key == name) return value;
  return {};
}

std::pair<double, double> angles_of(Photometry::Type type, const Vec3& d) {
  const double x = static_cast<double>(d.x), y = static_cast<double>(d.y), z = static_cast<double>(d.z);
  const auto degrees = [](double v) { return v / kDegree; };
  const auto arccos = [&](double v) { return degrees(std::acos(std::clamp(v, -1.0, 1.0))); };
  switch (type) {
    case Photometry::Type::a:
      return {degrees(std::atan2(x, -z)), arccos(-y)};
    case Photometry::Type::b:
      return {degrees(std::atan2(y, -z)), arccos(-x)};
    default:
      break;
  }
  const double c = degrees(std::atan2(y, x));
  return {c < 0 ? c + 360 : c, arccos(-z)};
}

Vec3 direction_of(Photometry::Type type, double azimuth, double polar) {
  const auto c = static_cast<float>(std::cos(azimuth * kDegree)),
             s = static_cast<float>(std::sin(azimuth * kDegree));
  const auto along = static_cast<float>(std::cos(polar * kDegree)),
             across = static_cast<float>(std::sin(polar * kDegree));
  switch (type) {
    case Photometry::Type::a:
      return {across * s, -along, -across * c};
    case Photometry::Type::b:
      return {-along, across * s, -across * c};
    default:
      return {across * c, across * s, -along};
  }
}

double intensity_at(const Photometry& p, double azimuth, double polar) {
  const auto a = place_in(p.azimuths, azimuth), g = place_in(p.polars, polar);
  if (!a || !g) return 0;
  const std::size_t a1 = std::min(a->low + 1, p.azimuths.size() - 1),
                    g1 = std::min(g->low + 1, p.polars.size() - 1);
  const double low = p.at(a->low, g->low) + g->weight * (p.at(a->low, g1) - p.at(a->low, g->low));
  const double high = p.at(a1, g->low) + g->weight * (p.at(a1, g1) - p.at(a1, g->low));
  return low + a->weight * (high - low);
}

double intensity(const Photometry& p, const Vec3& direction) {
  // Of a circle with one plane the azimuth does not matter: half of the time goes into it.
  if (p.type == Photometry::Type::c && p.azimuths.size() == 2)
    return intensity_at(p, 0, std::acos(std::clamp(-static_cast<double>(direction.z), -1.0, 1.0)) / kDegree);
  const auto [azimuth, polar] = angles_of(p.type, direction);
  return intensity_at(p, azimuth, polar);
}

double zone_integral(double from, double to, double at_from, double at_to) {
  const double t0 = from * kDegree, t1 = to * kDegree;
  if (!(t1 > t0)) return 0;
  const double b = (at_to - at_from) / (t1 - t0), a = at_from - b * t0;
  // The antiderivative of (a + b t) sin t is b sin t - (a + b t) cos t.
  return (b * std::sin(t1) - (a + b * t1) * std::cos(t1)) - (b * std::sin(t0) - (a + b * t0) * std::cos(t0));
}

double flux(const Photometry& p) {
  return flux_between(p, 0, 180);
}

double downward_fraction(const Photometry& p) {
  const double all = flux(p);
  return all > 0 ? flux_between(p, 0, 90) / all : 1;
}

Symmetry symmetry_of(const Photometry& p) {
  if (p.type != Photometry::Type::c) return Symmetry::none;
  bool axial = true;
  for (std::size_t i = 1; i < p.azimuths.size() && axial; ++i) axial = same_column(p, 0, i);
  if (axial) return Symmetry::axial;
  const bool c0 = mirrored(p, [](double c) { return 360 - c; });
  const bool c90 = mirrored(p, [](double c) { return c <= 180 ? 180 - c : 540 - c; });
  if (c0 && c90) return Symmetry::quadrants;
  return c0 ? Symmetry::about_c0 : c90 ? Symmetry::about_c90 : Symmetry::none;
}

const char* name_of(Symmetry symmetry) {
  constexpr const char* kNames[] = {"none", "about the vertical axis", "in quadrants", "about C0-C180",
                                    "about C90-C270"};
  return kNames[static_cast<std::size_t>(symmetry)];
}

Photometry as_type_c(const Photometry& p, double azimuth_step, double polar_step) {
  if (p.type == Photometry::Type::c) return p;
  Photometry out = p;
  out.type = Photometry::Type::c;
  out.azimuths.clear();
  out.polars.clear();
  out.candela.clear();
  const int planes = static_cast<int>(std::lround(360 / azimuth_step)),
            zones = static_cast<int>(std::lround(180 / polar_step));
  for (int i = 0; i <= planes; ++i) out.azimuths.push_back(i * 360.0 / planes);
  for (int i = 0; i <= zones; ++i) {
    out.polars.push_back(i * 180.0 / zones);
    // Types A and B end at the horizon, where they may be bright: the step must not be spread over a zone.
    if (out.polars.back() == 90) out.polars.push_back(90 + kPastHorizon);
  }
  for (const double c : out.azimuths)
    for (const double gamma : out.polars)
      out.candela.push_back(intensity(p, direction_of(Photometry::Type::c, c < 360 ? c : 0, gamma)));
  return out;
}

double tilt_factor(const LampTilt& tilt, double degrees) {
  if (tilt.angles.empty()) return 1;
  const double v = std::clamp(degrees, tilt.angles.front(), tilt.angles.back());
  const auto place = place_in(tilt.angles, v);
  const std::size_t next = std::min(place->low + 1, tilt.angles.size() - 1);
  return tilt.factors[place->low] + place->weight * (tilt.factors[next] - tilt.factors[place->low]);
}

}  // namespace sconce
