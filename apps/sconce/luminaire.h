// SPDX-License-Identifier: Apache-2.0
// `sconce luminaire ACTION FILE...`: measured lamps outside of any scene. One file per action.
#pragma once

#include <nlohmann/json.hpp>

#include "app.h"
#include "photometry/light_field_file.h"
#include "photometry/photometry.h"
#include "photometry/rays.h"

namespace sconce::app {

/// What info and convert take, for their help.
inline constexpr const char* kAnyLamp =
    "IES LM-63, EULUMDAT, TM-33, GLDF, light field (.exr), TM-25, LightTools, Zemax, SPEOS or ASAP rays";

/// The verb's own verbs.
std::span<const Verb> luminaire_actions();

int run_luminaire_info(int argc, const char* const* argv);
int run_luminaire_check(int argc, const char* const* argv);
int run_luminaire_convert(int argc, const char* const* argv);
int run_luminaire_field(int argc, const char* const* argv);
int run_luminaire_acquire(int argc, const char* const* argv);
int run_luminaire_render(int argc, const char* const* argv);

/// The far field of a file: its table, or that of its rays or light field (.exr).
struct LuminaireSource {
  Photometry photometry;
  std::optional<RayFile> rays;
  double ray_flux = 0;  ///< in the rays' unit
  std::string field;    ///< of a light field: describe()

  /// Rays in watts tell how light spreads, but not how much.
  bool in_watts() const { return rays && !rays->luminous; }
};
/// What a table's reader found odd becomes warnings. @param step  degrees between the angles of a table made
/// from rays
LuminaireSource read_luminaire(const std::string& file, double step, const Progress& progress);

/// Flux that lands on a large sphere around the lamp as the solvers see it, lm: what sconce renders.
double rendered_flux(const Photometry& photometry);

/// --coding of those that write light fields.
void add_coding(Options& options, std::string& coding);
/// @throws UsageError naming the choices
FieldCoding parse_coding(const std::string& coding);

/// Grid, planes and pixels of a light field.
std::string describe(const LightField& field);
/// "0.60 x 0.30 m box", "point".
std::string describe(const Opening& opening);

}  // namespace sconce::app
