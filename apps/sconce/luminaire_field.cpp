// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "luminaire.h"
#include "luminaire_rays.h"
#include "measure/field.h"
#include "photometry/formats.h"

namespace sconce::app {

namespace {

constexpr int kFarPlanes = 72, kFarZones = 180;

NearBasis parse_basis(const std::string& name) {
  if (const auto basis = basis_named(name)) return *basis;
  throw UsageError("--basis", "'" + name + "' is unknown", "bell, spline");
}

/// The far field of all rays, those beyond `--angle` too.
void write_far(const std::string& file, const LampRays& rays, double scale) {
  FarFieldBins bins(kFarPlanes, kFarZones);
  rays.each([&](std::span<const SourceRay> some) { bins.add(some); });
  Photometry table = bins.table();
  for (double& candela : table.candela) candela *= scale;
  write_file(file, write_ies(table));
}

}  // namespace

int run_luminaire_field(int argc, const char* const* argv) {
  std::string file, output, far, basis = "spline", coding = "float";
  FieldParams params;
  double spacing = 5, distance = 0, count = 4e6;
  int seed = 1;
  Options options(
      "luminaire field",
      "Rays of a lamp, or a luminaire modelled as a scene, to its near-field light field "
      "(docs/luminaires.md).",
      {"sconce luminaire field lamp.tm25ray -o torch.exr", "sconce luminaire field lamp.glb -o torch.exr",
       "sconce luminaire render {FILE} -o wall.png"});
  options.positional(
      "file", &file,
      "TM-25, LightTools, Zemax, SPEOS or ASAP rays; or a scene (.glb, .obj, .fbx, .l3d, ...) with emissive "
      "faces: a luminaire that hangs, nadir -y, metals its mirrors");
  options.option("-o,--output", &output, "light field to write, .exr");
  add_coding(options, coding);
  options.option("--basis", &basis, "spline, or the paper's bell");
  options.option("--spacing", &spacing, "millimetres between filters on the sampling plane");
  options.option("--distance", &distance, "millimetres to the measurement plane; 0 = 25 spacings");
  options.option("--angle", &params.angle, "rays further from nadir are left out, degrees");
  options.option("--pixels", &params.pixels, "of an image's edge");
  options.option("--lumens", &params.lumens, "scale to this luminous flux; 0 = as it is");
  add_bench(options, count, seed);
  options.option("--far", &far, "far field of the same rays to write too, .ies");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "is missing", "a file .exr");
  const FieldCoding as = parse_coding(coding);
  if (!(spacing > 0)) throw UsageError("--spacing", "is not positive", "millimetres > 0");
  if (!(distance >= 0)) throw UsageError("--distance", "is negative", "millimetres >= 0");
  if (!(params.angle > 0 && params.angle < 85))
    throw UsageError("--angle", "is out of range", "degrees above 0 and below 85");
  if (params.pixels < 8 || params.pixels > 2048) throw UsageError("--pixels", "is out of range", "8 to 2048");
  if (!(params.lumens >= 0)) throw UsageError("--lumens", "is negative", "lm >= 0");
  params.basis = parse_basis(basis);
  params.spacing = spacing * 1e-3, params.distance = distance * 1e-3;
  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  LampRays rays(file, count, seed, progress);
  rays.keep();
  const auto each = [&](const auto& f) {
    rays.each(f);
    if (!rays.luminous() && !(params.lumens > 0))
      throw UsageError("--lumens", "is needed: the rays of " + file + " are in watts",
                       "the lamp's luminous flux");
  };
  const MeasuredField measured = measure_field(each, params, file);
  const LightField& field = measured.field;
  write_light_field(output, field, as);
  if (!far.empty()) write_far(far, rays, measured.scale);
  const double spread = geometric_spread(1, 4 * field.spacing / field.distance);
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"file", output},
                                      {"columns", field.columns},
                                      {"rows", field.rows},
                                      {"lumens", measured.kept},
                                      {"lumens_lost", measured.lost},
                                      {"plane", measured.plane},
                                      {"spread_at_45", spread}}
                           .dump(2));
  else if (!options.quiet)
    fmt::print(
        "{}: {} x {} filters of {} x {} pixels, {:.4g} lm, {:.4g} lm beyond {:g} degrees or upward left out; "
        "cos4 varies by {:.1f} % over a filter at 45 degrees\n",
        output, field.columns, field.rows, field.width, field.height, measured.kept, measured.lost,
        params.angle, 100 * spread);
  options.next({output});
  return kDone;
}

}  // namespace sconce::app
