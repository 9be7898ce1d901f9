// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "luminaire.h"
#include "photometry/formats.h"

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

}  // namespace

int run_luminaire_convert(int argc, const char* const* argv) {
  std::string file, output;
  double lumens = 0, step = 5;
  Options options("luminaire convert",
                  "A photometric file in another format, or the far field of rays or a light field.");
  options.positional("file", &file,
                     "IES LM-63, EULUMDAT, TM-33, light field (.exr), TM-25, LightTools or Zemax rays");
  options.option("-o,--output", &output, "file to write: .ies (LM-63-2002) or .ldt (EULUMDAT)");
  options.option("--lumens", &lumens, "scale to this luminous flux; 0 = as it is");
  options.option("--step", &step, "rays, light fields: degrees between angles of the table");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "is missing", "a file .ies or .ldt");
  if (!(lumens >= 0)) throw UsageError("--lumens", "is negative", "lumens >= 0");
  if (!(step >= 0.5 && step <= 30)) throw UsageError("--step", "is out of range", "0.5 to 30 degrees");
  const std::string type = lower(std::filesystem::path(output).extension().string());
  if (type != ".ies" && type != ".ldt")
    throw UsageError("-o", "'" + output + "' names no format", ".ies, .ldt");
  LuminaireSource source = read_luminaire(file, step, make_progress(options));
  if (source.rays && !source.rays->luminous && !(lumens > 0))
    throw UsageError("--lumens", "is needed: the rays of " + file + " are in watts",
                     "the lamp's luminous flux");
  const Photometry p =
      lumens > 0 ? scaled(std::move(source.photometry), lumens, file) : std::move(source.photometry);
  const std::string text = type == ".ies" ? write_ies(p) : write_ldt(p);
  write_file(output, text);
  const double before = flux(p),
               after = flux(type == ".ies" ? parse_ies(text, output) : parse_ldt(text, output));
  if (options.json)
    fmt::print("{}\n",
               nlohmann::json{{"file", output}, {"lumens", after}, {"lumens_before", before}}.dump(2));
  else if (!options.quiet)
    fmt::print("{}: {:.1f} lm ({:+.3f} %)\n", output, after, before > 0 ? 100 * (after / before - 1) : 0.0);
  return kDone;
}

}  // namespace sconce::app
