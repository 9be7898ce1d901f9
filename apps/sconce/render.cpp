// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "image/io.h"
#include "mix_options.h"
#include "picture_options.h"
#include "picture_output.h"
#include "stage.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

using Clock = std::chrono::steady_clock;

struct Rendered {
  std::unique_ptr<Stage> stage;  ///< with the picture drawn
  Camera camera;
  PictureParams params;
  MixSpec mix;
  Metering metering;
};

Rendered render(const Package& package, const PictureOptions& picture, const MixOptions& settings,
                const Preset& preset, bool metered, const Progress& progress) {
  Rendered out;
  out.mix = settings.make(preset, package.manifest().groups, progress);
  out.stage = make_stage(package, picture.device, picture.tier, !picture.no_reflections);
  out.camera =
      picture.find_camera(out.stage->scene(), [&] { return out.stage->eye_height_camera(progress); });
  out.params = picture.params(out.camera);
  progress.check();
  const std::vector<Image> pages = mix_pages(package, out.mix);
  if (metered) out.metering = meter(package, out.stage->scene(), out.mix, pages);
  out.stage->draw(out.camera, out.mix, pages, out.params, progress);
  return out;
}

}  // namespace

int run_render(int argc, const char* const* argv) {
  const auto start = Clock::now();
  std::string input, output, coverage;
  MixOptions settings;
  PictureOptions picture;
  Options options("render",
                  "A picture of a package through a camera: base colour x mixed lightmap, visible emitters, "
                  "exposure, tone curve.",
                  {"sconce render kitchen.sconce window=off ceiling=2700K,50% -o evening.png",
                   "sconce render kitchen.sconce --others off lamp=1 --camera stove --size 1920",
                   "sconce view {PACKAGE}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  settings.declare(options);
  picture.declare(options);
  options.option(
      "-o,--output", &output,
      "PNG (toned), or OpenEXR (linear, cd/m2; exposed only when asked for); - is PNG on stdout (default: "
      "NAME.png)");
  options.option("--coverage", &coverage,
                 "OpenEXR of the share of each pixel that shows an emitter, for 'diff --mask'");
  if (const auto code = options.parse(argc, argv)) return *code;

  const bool tone_given = !picture.tone.curve.empty();
  const Preset preset = settings.preset();
  picture.apply(preset);
  picture.check();
  if (output.empty()) output = default_output(input, ".png");
  check_output(output, {".png", ".exr"});
  if (!coverage.empty()) check_output(coverage, {".exr"});
  if (output == "-" && options.json) throw UsageError({}, "-o - and --json both want standard output");
  const bool linear = lower(fs::path(output).extension().string()) == ".exr";
  if (linear && picture.device == "software")
    throw UsageError("option '--device'", "software draws no linear picture", "-o FILE.png");
  const ToneMapper& tone = picture.tone.mapper();
  const ExposureChoice choice = picture.tone.exposure_choice();
  const bool exposed = !linear || choice.explicitly;

  const ThreadLimit threads(options.threads);
  Rendered rendered;
  Exposure exposure;
  std::vector<GroupInfo> groups;
  std::string device;
  {
    const Progress progress = make_progress(options);
    if (linear && tone_given && tone.name != "linear")
      progress.warn("an OpenEXR picture stays linear: --tone " + picture.tone.curve + " is not applied");
    const Package package = settings.open(input);
    groups = package.manifest().groups;
    rendered = render(package, picture, settings, preset, exposed, progress);
    exposure = exposed ? choice.resolve(rendered.metering) : unit_exposure(rendered.metering.maximum);
    const Stage& stage = *rendered.stage;
    if (!coverage.empty()) write_exr(coverage, stage.coverage(), PixelType::half);
    linear ? write_linear(output, stage.linear(), exposure)
           : write_toned(output, stage.toned(exposure, tone));
    device = stage.device();
    rendered.stage.reset();  // before the package
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string exposure_text = exposed ? choice.text() : "none";
  if (options.json) {
    nlohmann::ordered_json report = {
        {"input", input},
        {"output", output},
        {"width", rendered.params.width},
        {"height", rendered.params.height},
        {"samples", rendered.params.samples},
        {"camera", rendered.camera.name},
        {"device", device},
        {"tone", linear ? "linear" : std::string(tone.name)},
        {"exposure", {{"mode", exposure_text}, {"scale", exposure.scale}}},
        {"groups", nlohmann::ordered_json::parse(weights_json(groups, rendered.mix))},
        {"seconds", seconds}};
    if (exposed) {
      report["exposure"]["log_mean"] = rendered.metering.log_mean;
      report["exposure"]["maximum"] = rendered.metering.maximum;
    }
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet && output != "-") {
    fmt::print("{}: {} x {}, camera {}, exposure {}, {:.1f} s\n", output, rendered.params.width,
               rendered.params.height, rendered.camera.name, exposure_text, seconds);
  }
  if (output != "-") options.next({input});
  return kDone;
}

}  // namespace sconce::app
