// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "luminaire.h"
#include "luminaire_rays.h"
#include "photometry/formats.h"
#include "photometry/ray_writer.h"

namespace sconce::app {

namespace {

/// Scaled to a flux.
Photometry scaled(Photometry p, double lumens, const std::string& file) {
  const double table = flux(p);
  if (!(table > 0)) throw Error(file, "has no light that could be scaled to --lumens");
  for (double& v : p.candela) v *= lumens / table;
  p.stated = lumens;
  p.absolute = true;
  for (LampSet& set : p.lamps) set.lumens = 0;
  return p;
}

/// Rays to TM-25, streamed. @return flux before and after
std::pair<double, double> convert_rays(const LampRays& rays, const std::string& file,
                                       const std::string& output, double lumens) {
  double before = 0, after = 0;
  bool colored = false;
  rays.each([&](std::span<const SourceRay> some) {
    for (const SourceRay& ray : some) {
      before += static_cast<double>(ray.flux);
      colored |= ray.color != Rgb(1);
    }
  });
  if (lumens > 0 && !(before > 0)) throw Error(file, "has no light that could be scaled to --lumens");
  RayWriter writer(output, rays.luminous() || lumens > 0, colored);
  const auto scale = static_cast<float>(lumens > 0 ? lumens / before : 1);
  std::vector<SourceRay> block;
  rays.each([&](std::span<const SourceRay> some) {
    block.assign(some.begin(), some.end());
    for (SourceRay& ray : block) after += static_cast<double>(ray.flux *= scale);
    writer.add(block);
  });
  writer.finish();
  return {before, after};
}

/// The far field of a file, or of a scene's rays.
Photometry far_field_of(const LampRays& rays, const std::string& file, double step, double lumens,
                        const Progress& progress) {
  if (rays.traced()) {
    FarFieldBins bins(static_cast<int>(std::lround(360 / step)), static_cast<int>(std::lround(180 / step)));
    rays.each([&](std::span<const SourceRay> some) { bins.add(some); });
    return bins.table();
  }
  LuminaireSource source = read_luminaire(file, step, progress);
  if (source.in_watts() && !(lumens > 0))
    throw UsageError("--lumens", "is needed: the rays of " + file + " are in watts",
                     "the lamp's luminous flux");
  return std::move(source.photometry);
}

/// A light field in another coding, scaled where lumens are given. @return flux before, and as it is written
std::pair<double, double> convert_field(const std::string& file, const std::string& output, double lumens,
                                        FieldCoding coding) {
  LightField field = read_light_field(file);
  const double before = flux(field);
  if (lumens > 0) {
    if (!(before > 0)) throw Error(file, "has no light that could be scaled to --lumens");
    const auto scale = static_cast<float>(lumens / before);
    for (std::vector<float>* values : {&field.irradiance, &field.color})
      for (float& v : *values) v *= scale;
    field.grain *= lumens / before;
  }
  write_light_field(output, field, coding);
  return {before, flux(read_light_field(output))};
}

}  // namespace

int run_luminaire_convert(int argc, const char* const* argv) {
  std::string file, output, coding = "float";
  double lumens = 0, step = 5, count = 4e6;
  int seed = 1;
  Options options(
      "luminaire convert",
      "A photometric file in another format, the far field of rays or a light field, rays or a modelled "
      "luminaire to TM-25, or a light field in another coding.",
      {"sconce luminaire convert lamp.tm25ray --lumens 800 -o lamp.ldt",
       "sconce luminaire convert torch.glb --rays 20000000 -o torch.tm25ray",
       "sconce luminaire check {FILE}"});
  options.positional("file", &file, fmt::format("{}; or a scene, as of luminaire field", kAnyLamp));
  options.option("-o,--output", &output,
                 "file to write: .ies (LM-63-2002), .ldt (EULUMDAT); of rays and scenes also .tm25ray, of "
                 "light fields .exr");
  add_coding(options, coding);
  options.option("--lumens", &lumens, "scale to this luminous flux; 0 = as it is");
  options.option("--step", &step, "rays, light fields: degrees between angles of the table");
  add_bench(options, count, seed);
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "is missing", "a file .ies, .ldt, .tm25ray or .exr");
  if (!(lumens >= 0)) throw UsageError("--lumens", "is negative", "lumens >= 0");
  if (!(step >= 0.5 && step <= 30)) throw UsageError("--step", "is out of range", "0.5 to 30 degrees");
  const std::string type = lower(std::filesystem::path(output).extension().string());
  if (type != ".ies" && type != ".ldt" && type != ".tm25ray" && type != ".exr")
    throw UsageError("-o", "'" + output + "' names no format", ".ies, .ldt, .tm25ray, .exr");
  if (type == ".exr" && lower(std::filesystem::path(file).extension().string()) != ".exr")
    throw UsageError("-o", "'" + output + "' is for light fields, and " + file + " is none",
                     "sconce luminaire field makes one of rays and scenes");
  const FieldCoding as = parse_coding(coding);
  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const auto report = [&](double before, double after) {
    if (options.json)
      fmt::print("{}\n",
                 nlohmann::json{{"file", output}, {"lumens", after}, {"lumens_before", before}}.dump(2));
    else if (!options.quiet)
      fmt::print("{}: {:.1f} lm ({:+.3f} %)\n", output, after, before > 0 ? 100 * (after / before - 1) : 0.0);
    options.next({output});
    return kDone;
  };
  if (type == ".exr") {
    const auto [before, after] = convert_field(file, output, lumens, as);
    return report(before, after);
  }
  const LampRays rays(file, count, seed, progress);
  if (type == ".tm25ray") {
    const auto [before, after] = convert_rays(rays, file, output, lumens);
    return report(before, after);
  }
  Photometry table = far_field_of(rays, file, step, lumens, progress);
  const Photometry p = lumens > 0 ? scaled(std::move(table), lumens, file) : std::move(table);
  const std::string text = type == ".ies" ? write_ies(p) : write_ldt(p);
  write_file(output, text);
  return report(flux(p), flux(type == ".ies" ? parse_ies(text, output) : parse_ldt(text, output)));
}

}  // namespace sconce::app
