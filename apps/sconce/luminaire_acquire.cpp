// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "app.h"
#include "core/error.h"
#include "core/parallel.h"
#include "goniometer/acquisition.h"
#include "image/io.h"
#include "luminaire.h"

namespace sconce::app {

namespace {

/// All terms side by side as they lie on the sampling plane, brightest white; positions to come are blue.
void write_preview(const std::filesystem::path& file, const Acquired& acquired) {
  const LightField& field = acquired.field();
  const float most = std::max(*std::max_element(field.irradiance.begin(), field.irradiance.end()), 1e-30f);
  Image8 out{field.columns * (field.width + 1), field.rows * (field.height + 1), 3, {}};
  out.data.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 3, 40);
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m)
      for (int t = 0; t < field.height; ++t)
        for (int s = 0; s < field.width; ++s) {
          const auto term = static_cast<std::size_t>(n * field.columns + m);
          const std::size_t at = term * field.pixels() + static_cast<std::size_t>(t * field.width + s);
          const int x = m * (field.width + 1) + s, y = (field.rows - n) * (field.height + 1) - 2 - t;
          unsigned char* to = &out.data[3 * static_cast<std::size_t>(y * out.width + x)];
          for (std::size_t c = 0; c < 3; ++c) {
            const float v =
                field.is_grey() ? field.irradiance[at] : field.color[c * field.irradiance.size() + at];
            to[c] = static_cast<unsigned char>(255 * linear_to_srgb(std::clamp(v / most, 0.0f, 1.0f)) + 0.5f);
          }
          if (!acquired.has(term)) to[2] = 120;
        }
  write_png(file, out);
}

}  // namespace

int run_luminaire_acquire(int argc, const char* const* argv) {
  std::string folder, output, settings, coding = "float";
  bool watch = false;
  Options options("luminaire acquire",
                  "Photographs of a lamp's filtered pattern, one per grid position, to a light field "
                  "(docs/luminaires.md).",
                  {"sconce luminaire acquire photographs -o torch.exr",
                   "sconce luminaire acquire photographs -o torch.exr --json",
                   "sconce luminaire render {FILE} -o wall.png"});
  options.positional("folder", &folder, "folder of photographs with its acquire.toml");
  options.option("-o,--output", &output, "light field to write, .exr");
  add_coding(options, coding);
  options.option("--settings", &settings, "how they were taken; default FOLDER/acquire.toml");
  options.flag("--watch", &watch,
               "wait for pictures that are still to come; OUTPUT.preview.png shows those that are there");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "is missing", "a file .exr");
  const FieldCoding as = parse_coding(coding);
  const Progress progress = make_progress(options);
  const ThreadLimit threads(options.threads);
  const std::filesystem::path dir = folder;
  Acquired acquired(
      dir, read_acquisition(settings.empty() ? dir / "acquire.toml" : std::filesystem::path(settings)));
  while (acquired.present() < acquired.positions()) {
    progress.check();
    const std::size_t came = acquired.update();
    progress.at("positions", acquired.present(), acquired.positions());
    if (watch && came > 0) write_preview(output + ".preview.png", acquired);
    if (acquired.present() == acquired.positions()) break;
    if (!watch)
      throw Error(
          (dir / acquired.missing()).string(),
          fmt::format("is missing: {} of {} positions are there", acquired.present(), acquired.positions()),
          "all pictures; --watch waits for them");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  const LightField& field = acquired.field();
  const double lumens = light_of(field, folder);
  write_light_field(output, field, as);
  if (options.json)
    fmt::print(
        "{}\n",
        nlohmann::json{{"file", output}, {"columns", field.columns}, {"rows", field.rows}, {"lumens", lumens}}
            .dump(2));
  else if (!options.quiet)
    fmt::print("{}: {} x {} filters of {} x {} pixels, {:.4g} lm\n", output, field.columns, field.rows,
               field.width, field.height, lumens);
  options.next({output});
  return kDone;
}

}  // namespace sconce::app
