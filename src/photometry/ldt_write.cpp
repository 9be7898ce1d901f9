// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "photometry/figures.h"
#include "photometry/formats.h"

namespace sconce {

namespace {

constexpr std::size_t kText = 78;  // characters that EULUMDAT allows in its longest fields

std::string field(const std::string& text) {
  std::string out = text.substr(0, kText);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return out;
}

/// The step of equal steps, else 0.
double step_of(const std::vector<double>& angles) {
  if (angles.size() < 2) return 0;
  const double step = angles[1] - angles[0];
  for (std::size_t i = 2; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return 0;
  return step;
}

struct Planes {
  int symmetry;                      ///< Isym
  std::vector<double> angles;        ///< all Mc
  std::vector<std::size_t> written;  ///< columns of the table
};

/// The symmetry codes need C0, C90, C180, C270 among the planes at their places in the list.
Planes planes_of(const Photometry& p) {
  Planes out;
  out.angles.assign(p.azimuths.begin(), p.azimuths.end() - 1);
  const std::size_t n = out.angles.size();
  const auto range = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i <= to; ++i) out.written.push_back(i);
  };
  const bool quarters =
      n % 4 == 0 && out.angles[n / 4] == 90 && out.angles[n / 2] == 180 && out.angles[3 * n / 4] == 270;
  switch (symmetry_of(p)) {
    case Symmetry::axial:
      out.symmetry = 1;
      out.angles = {0};
      out.written = {0};
      return out;
    case Symmetry::quadrants:
      if (!quarters) break;
      out.symmetry = 4;
      range(0, n / 4);
      return out;
    case Symmetry::about_c0:
      if (n % 2 != 0 || out.angles[n / 2] != 180) break;
      out.symmetry = 2;
      range(0, n / 2);
      return out;
    case Symmetry::about_c90:
      if (!quarters) break;
      out.symmetry = 3;
      range(3 * n / 4, n - 1);
      range(0, n / 4);
      return out;
    default:
      break;
  }
  out.symmetry = 0;
  range(0, n - 1);
  return out;
}

}  // namespace

std::string write_ldt(const Photometry& given) {
  const Photometry p = as_type_c(given);
  const double lumens = flux(p);
  if (!(lumens > 0))
    throw Error("EULUMDAT", "cannot hold a luminaire without light: its intensities are relative to a flux");
  LampSet lamp = p.lamps.empty() ? LampSet{} : p.lamps.front();
  if (p.absolute && !(lamp.lumens > 0)) lamp.lumens = lumens;
  const bool relative = lamp.lumens > 0;
  if (!relative) lamp.lumens = lumens;
  const Planes planes = planes_of(p);
  const bool round = p.opening.shape != Opening::Shape::box;
  const auto mm = [](float metres) { return fmt::format("{:.6g}", metres * 1000); };

  std::string out;
  const auto line = [&](const auto& v) { out += fmt::format("{}\r\n", v); };
  line(field(p.keyword("MANUFAC")));
  line(planes.symmetry == 1 ? 1 : p.opening.size.y > 2 * p.opening.size.x ? 2 : 3);
  line(planes.symmetry);
  line(planes.angles.size());
  line(planes.symmetry == 1 ? 0 : step_of(planes.angles));
  line(p.polars.size());
  line(step_of(p.polars));
  for (const char* key : {"TEST", "LUMINAIRE", "LUMCAT", "_FILE", "ISSUEDATE"}) line(field(p.keyword(key)));
  // The housing is not known here: it is at least what shines.
  line(mm(p.opening.size.y)), line(round ? "0" : mm(p.opening.size.x)), line(mm(p.opening.size.z));
  line(mm(p.opening.size.y)), line(round ? "0" : mm(p.opening.size.x));
  for (int side = 0; side < 4; ++side) line(mm(p.opening.size.z));
  line(fmt::format("{:.6g}", 100 * downward_fraction(p)));
  line(fmt::format("{:.6g}", 100 * p.stated.value_or(lumens) / lamp.lumens));
  line(1), line(0), line(1);
  line(p.absolute ? -lamp.count : lamp.count);
  line(field(lamp.name)), line(lamp.lumens), line(field(lamp.color)), line(field(lamp.rendering)),
      line(lamp.watts);
  for (const double ratio : direct_ratios(p)) line(fmt::format("{:.4f}", ratio));
  for (const double c : planes.angles) line(c);
  for (const double gamma : p.polars) line(gamma);
  for (const std::size_t plane : planes.written)
    for (std::size_t g = 0; g < p.polars.size(); ++g) line(p.at(plane, g) * 1000 / lamp.lumens);
  return out;
}

}  // namespace sconce
