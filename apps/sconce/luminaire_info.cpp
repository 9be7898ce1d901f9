// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "app.h"
#include "luminaire.h"
#include "photometry/figures.h"
#include "table.h"

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kRayStep = 5;  // degrees

/// In the angles that the file has.
std::string place_of(const Photometry& p, const Peak& peak) {
  switch (p.type) {
    case Photometry::Type::a:
      return fmt::format("horizontal {:g}, vertical {:g}", peak.azimuth, peak.polar - 90);
    case Photometry::Type::b:
      return fmt::format("horizontal {:g}, vertical {:g}", peak.polar - 90, peak.azimuth);
    default:
      return fmt::format("C {:g}, gamma {:g}", peak.azimuth, peak.polar);
  }
}

}  // namespace

int run_luminaire_info(int argc, const char* const* argv) {
  std::string file;
  Options options("luminaire info", "What a photometric file, a ray file or a light field says.",
                  {"sconce luminaire info lamp.ldt", "sconce luminaire info lamp.ies --json",
                   "sconce luminaire check {FILE}"});
  options.positional("file", &file, kAnyLamp);
  if (const auto code = options.parse(argc, argv)) return *code;
  const Progress progress = make_progress(options);
  const LuminaireSource source = read_luminaire(file, kRayStep, progress);
  const Photometry& p = source.photometry;

  const Photometry c = as_type_c(p);
  const Peak peak = peak_of(p);
  const double lumens = flux(p);
  const LampSet lamp = p.lamps.empty() ? LampSet{} : p.lamps.front();
  constexpr const char* kTypes[] = {"C", "B", "A"};
  Json json = {{"file", file},
               {"format", source.rays ? source.rays->format : p.format},
               {"type", kTypes[static_cast<std::size_t>(p.type)]},
               {"planes", p.azimuths.size()},
               {"angles", p.polars.size()},
               {"symmetry", name_of(symmetry_of(p))},
               {"lumens", lumens},
               {"lumens_stated", p.stated ? Json(*p.stated) : Json()},
               {"lamp_lumens", lamp.lumens},
               {"absolute", p.absolute},
               {"watts", lamp.watts},
               {"downward_fraction", downward_fraction(c)},
               {"peak_candela", peak.candela},
               {"peak_azimuth", peak.azimuth},
               {"peak_polar", peak.polar},
               {"beam_c0", beam_angle(c, 0, 0.5)},
               {"beam_c90", beam_angle(c, 90, 0.5)},
               {"field_c0", beam_angle(c, 0, 0.1)},
               {"field_c90", beam_angle(c, 90, 0.1)},
               {"opening", {p.opening.size.x, p.opening.size.y, p.opening.size.z}},
               {"notes", p.notes}};
  if (source.rays) json["unit"] = source.in_watts() ? "W" : "lm";
  if (!source.field.empty()) json["light_field"] = source.field;
  if (source.rays) json["rays"] = source.rays->rays;
  if (options.json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
    return kDone;
  }
  if (options.quiet) return kDone;
  const auto line = [](const char* name, const std::string& text) {
    if (!text.empty()) fmt::print("{:<14}{}\n", name, text);
  };
  line("file", file);
  if (source.rays)
    line("format", fmt::format("{}, {} rays, {:.6g} {}", source.rays->format,
                               grouped(static_cast<double>(source.rays->rays)), source.ray_flux,
                               source.in_watts() ? "W" : "lm"));
  else
    line("format", fmt::format("{}, type {}, {} planes x {} angles", p.format,
                               kTypes[static_cast<std::size_t>(p.type)], p.azimuths.size(), p.polars.size()));
  line("light field", source.field);
  for (const auto& [key, name] :
       {std::pair("MANUFAC", "maker"), std::pair("LUMINAIRE", "luminaire"), std::pair("LUMCAT", "number")})
    line(name, p.keyword(key));
  if (source.in_watts())
    line("flux", fmt::format("{:.4g} W; --lumens of `convert` and `field` says the luminous flux", lumens));
  else
    line("flux", fmt::format("{:.1f} lm{}{}", lumens,
                             p.stated ? fmt::format(", stated {:.1f} ({:+.2f} %)", *p.stated,
                                                    100 * (lumens / *p.stated - 1))
                                      : "",
                             p.absolute        ? ", absolute"
                             : lamp.lumens > 0 ? fmt::format(", {:.1f} % of its lamps' {:.0f} lm",
                                                             100 * lumens / lamp.lumens, lamp.lumens)
                                               : ""));
  if (lamp.watts > 0) line("power", fmt::format("{:.4g} W, {:.0f} lm/W", lamp.watts, lumens / lamp.watts));
  for (const LampSet& set : p.lamps)
    if (!set.name.empty() || !set.color.empty())
      line("lamps", fmt::format("{} x {}{} {} {}", set.count, set.name,
                                set.lumens > 0 ? fmt::format(" {:.0f} lm", set.lumens) : "", set.color,
                                set.rendering));
  if (!p.tilt.angles.empty()) {
    const auto [least, most] = std::minmax_element(p.tilt.factors.begin(), p.tilt.factors.end());
    line("TILT", fmt::format("factors from {:g} to {:g} for {:g} to {:g} degrees of tilt, geometry {}",
                             *least, *most, p.tilt.angles.front(), p.tilt.angles.back(), p.tilt.geometry));
  }
  line("downward", fmt::format("{:.1f} %", 100 * downward_fraction(c)));
  line("peak",
       fmt::format("{:.4g} {} at {}", peak.candela, source.in_watts() ? "W/sr" : "cd", place_of(p, peak)));
  line("beam", fmt::format("{:.0f} x {:.0f} degrees at half, {:.0f} x {:.0f} at a tenth (C0 x C90)",
                           beam_angle(c, 0, 0.5), beam_angle(c, 90, 0.5), beam_angle(c, 0, 0.1),
                           beam_angle(c, 90, 0.1)));
  line("symmetry", name_of(symmetry_of(p)));
  line("opening", describe(p.opening));
  options.next({file});
  return kDone;
}

}  // namespace sconce::app
