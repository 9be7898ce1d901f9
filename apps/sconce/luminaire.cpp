// SPDX-License-Identifier: Apache-2.0
#include "luminaire.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "app.h"
#include "core/error.h"
#include "core/text.h"
#include "photometry/formats.h"

namespace sconce::app {

namespace {

constexpr Verb kActions[] = {
    {"info", "what a photometric file or a ray file says: flux, beam, symmetry, size", run_luminaire_info},
    {"check", "what is wrong with it: flux, gaps, headers; UGR table, polar diagram", run_luminaire_check},
    {"convert",
     "IES to EULUMDAT and back; rays and scenes to a far field or TM-25; light fields in another coding",
     run_luminaire_convert},
    {"field", "rays to a near-field light field", run_luminaire_field},
    {"acquire", "photographs of a lamp to a near-field light field", run_luminaire_acquire},
    {"render", "what the lamp alone throws onto a wall", run_luminaire_render},
};

}  // namespace

std::span<const Verb> luminaire_actions() {
  return kActions;
}

int run_luminaire(int argc, const char* const* argv) {
  const std::string name = argc > 0 ? argv[0] : "";
  std::vector<std::string> names;
  for (const Verb& action : kActions) {
    if (name == action.name) return action.run(argc - 1, argv + 1);
    names.emplace_back(action.name);
  }
  if (name == "--help" || name == "-h") {
    fmt::print(
        "usage: sconce luminaire ACTION FILE [options]\n\nMeasured lamps: IES LM-63, EULUMDAT, TM-33, GLDF, "
        "ray files, light fields.\n\n");
    fmt::print("{}\n'sconce luminaire ACTION --help' lists its options.\n", verbs_text(kActions));
    return kDone;
  }
  throw UsageError(
      {}, name.empty() ? "missing action" : "unknown action '" + name + "'" + did_you_mean(name, names),
      join(names, ", "));
}

LuminaireSource read_luminaire(const std::string& file, double step, const Progress& progress) {
  LuminaireSource out;
  if (lower(std::filesystem::path(file).extension().string()) == ".exr") {
    LightField field = read_light_field(file);
    out.field = describe(field);
    out.photometry = far_field(NearLamp(std::move(field)), step);
    return out;
  }
  FarFieldBins bins(static_cast<int>(std::lround(360 / step)), static_cast<int>(std::lround(180 / step)));
  try {
    out.rays = read_rays(
        file, [&](std::span<const SourceRay> rays) { bins.add(rays); }, progress);
  } catch (const NotMyFormat&) {
    try {
      out.photometry = read_photometry(file);
    } catch (const NotMyFormat&) {
      const std::string type = lower(std::filesystem::path(file).extension().string());
      if (type == ".ies" || type == ".ldt") throw;
      throw Error(file, "is no lamp that can be read", kAnyLamp);
    }
    for (const std::string& note : out.photometry.notes) progress.warn(file + ": " + note);
    return out;
  }
  out.ray_flux = bins.flux();
  if (!(out.ray_flux > 0)) throw Error(file, "holds rays without flux");
  if (const double stated = out.rays->stated; stated > 0 && std::abs(out.rays->held / stated - 1) > 0.005)
    progress.warn(fmt::format("{}: its header states a flux of {:.6g}, its rays hold {:.6g}", file, stated,
                              out.rays->held));
  out.photometry = bins.table();
  return out;
}

void add_coding(Options& options, std::string& coding) {
  options.option(
      "--coding", &coding,
      "light fields: how .exr keeps values, float (32 bits), half (1/2048), srgbe (4 bytes for three "
      "values, 1/127 of the largest)");
}

FieldCoding parse_coding(const std::string& coding) {
  if (const auto found = coding_named(coding)) return *found;
  throw UsageError("--coding", "'" + coding + "' is unknown", "float, half, srgbe");
}

std::string describe(const LightField& field) {
  return fmt::format("{} x {} filters ({}) of {:g} mm, screen {:g} mm below, {} x {} pixels of {:.3g} mm, {}",
                     field.columns, field.rows, name_of(field.basis), 1000 * field.spacing,
                     1000 * field.distance, field.width, field.height, 1000 * field.pixel,
                     field.is_grey() ? "grey" : "in colours");
}

std::string describe(const Opening& o) {
  if (o.is_point()) return "point";
  const std::string size = fmt::format("{:.3g} x {:.3g} x {:.3g} m", o.size.x, o.size.y, o.size.z);
  constexpr const char* kShapes[] = {"box", "cylinder", "ellipsoid"};
  const bool disk = o.shape == Opening::Shape::cylinder && o.axis == 2 && o.size.z == 0;
  const bool flat = o.shape == Opening::Shape::box && o.size.z == 0;
  return size + " (C0, C90, height) " +
         (disk   ? "disk"
          : flat ? "rectangle"
                 : kShapes[static_cast<std::size_t>(o.shape)]);
}

}  // namespace sconce::app
