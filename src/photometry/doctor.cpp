// SPDX-License-Identifier: Apache-2.0
#include "photometry/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "photometry/figures.h"

namespace sconce {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTolerance = 0.005;  // of a stated flux
constexpr double kWidePlanes = 45, kWideZones = 10;

class Doctor {
 public:
  explicit Doctor(const Photometry& p) : p_(p), flux_(flux(p)), peak_(peak_of(p).candela) {}

  std::vector<Finding> run() {
    for (const std::string& note : p_.notes) warn(note);
    if (!(flux_ > 0)) {
      warn("the table holds no light at all");
      return std::move(out_);
    }
    check_flux();
    check_steps();
    check_poles();
    check_end();
    if (p_.opening.is_point())
      remark("no luminous opening: the lamp is a point, its shadows are hard and it has no UGR");
    return std::move(out_);
  }

 private:
  void warn(std::string text) { out_.push_back({true, std::move(text)}); }
  void remark(std::string text) { out_.push_back({false, std::move(text)}); }

  void check_flux() {
    const double lamps = p_.lamps.empty() ? 0 : p_.lamps.front().lumens;
    const double off = p_.stated ? flux_ / *p_.stated - 1 : 0;
    const bool told = off > kTolerance && *p_.stated > lamps * (1 - kTolerance);  // below: the same flux
    if (!p_.absolute && lamps > 0 && flux_ > lamps * (1 + kTolerance) && !told)
      warn(fmt::format("gives {:.0f} lm, more than the {:.0f} lm of its lamps", flux_, lamps));
    if (!p_.stated) {
      remark("the file does not state the luminaire's flux");
      return;
    }
    if (std::abs(off) <= kTolerance) return;
    const FluxBounds bounds = flux_bounds(p_);
    const bool coarse = *p_.stated >= bounds.low && *p_.stated <= bounds.high;
    warn(fmt::format(
        "integrates to {:.1f} lm where {:.1f} lm are stated ({:+.1f} %){}", flux_, *p_.stated, 100 * off,
        coarse ? fmt::format("; its steps are too wide for its beam to tell: {:.0f} to {:.0f} lm", bounds.low,
                             bounds.high)
               : ""));
  }

  void check_steps() {
    double planes = 0, zones = 0;
    for (std::size_t i = 1; i < p_.azimuths.size(); ++i)
      planes = std::max(planes, p_.azimuths[i] - p_.azimuths[i - 1]);
    for (std::size_t i = 1; i < p_.polars.size(); ++i)
      zones = std::max(zones, p_.polars[i] - p_.polars[i - 1]);
    if (symmetry_of(p_) != Symmetry::axial && planes > kWidePlanes)
      warn(fmt::format("planes are up to {:g} degrees apart; intensity in between is a guess", planes));
    if (zones > kWideZones) warn(fmt::format("angles within a plane are up to {:g} degrees apart", zones));
  }

  void check_poles() {
    for (const auto& [polar, name] : {std::pair(0.0, "nadir"), std::pair(180.0, "zenith")}) {
      const std::size_t g = polar == 0 ? 0 : p_.polars.size() - 1;
      if (p_.type != Photometry::Type::c || p_.polars[g] != polar) continue;
      double low = p_.at(0, g), high = low;
      for (std::size_t a = 1; a < p_.azimuths.size(); ++a)
        low = std::min(low, p_.at(a, g)), high = std::max(high, p_.at(a, g));
      if (high - low > 0.01 * peak_)
        warn(fmt::format("planes disagree at {}: {:.4g} to {:.4g} cd in one direction", name, low, high));
    }
  }

  /// A table that stops while bright goes on in the lamp, not in the file.
  void check_end() {
    const std::size_t g = p_.polars.size() - 1;
    if (p_.type != Photometry::Type::c || p_.polars[g] >= 180) return;
    double most = 0;
    for (std::size_t a = 0; a < p_.azimuths.size(); ++a) most = std::max(most, p_.at(a, g));
    if (most > 0.05 * peak_)
      warn(fmt::format("the table ends at {:g} degrees with {:.0f} % of its peak; beyond it is dark",
                       p_.polars[g], 100 * most / peak_));
  }

  const Photometry& p_;
  double flux_, peak_;
  std::vector<Finding> out_;
};

}  // namespace

FluxBounds flux_bounds(const Photometry& p) {
  double sum = 0;
  for (std::size_t a = 0; a + 1 < p.azimuths.size(); ++a)
    for (std::size_t g = 0; g + 1 < p.polars.size(); ++g) {
      const auto weighted = [&](std::size_t at) {
        return 0.5 * (p.at(a, at) + p.at(a + 1, at)) * std::sin(p.polars[at] * kDegree);
      };
      sum += 0.5 * (weighted(g) + weighted(g + 1)) * (p.polars[g + 1] - p.polars[g]) * kDegree *
             (p.azimuths[a + 1] - p.azimuths[a]) * kDegree;
    }
  const double linear = flux(p);
  return {std::min(sum, linear), std::max(sum, linear)};
}

std::vector<Finding> examine(const Photometry& photometry) {
  return Doctor(photometry).run();
}

}  // namespace sconce
