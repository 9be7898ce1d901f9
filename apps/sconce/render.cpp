// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "image/io.h"
#include "mix_options.h"
#include "picture_layers.h"
#include "picture_options.h"
#include "picture_output.h"
#include "picture_sequence.h"
#include "session/turntable.h"
#include "stage.h"
#include "tone/apply.h"

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

/// Nothing is drawn yet.
Rendered open(const Package& package, const PictureOptions& picture, const std::string& device, MixSpec mix,
              const Progress& progress) {
  Rendered out;
  out.mix = std::move(mix);
  out.stage = make_stage(package, device, picture.tier, !picture.no_reflections);
  out.camera =
      picture.find_camera(out.stage->scene(), [&] { return out.stage->eye_height_camera(progress); });
  out.params = picture.params(out.camera);
  return out;
}

void render(Rendered& out, const Package& package, bool metered, bool draws, const Progress& progress) {
  progress.check();
  if (!metered && !draws) return;
  const std::vector<Image> pages = mix_pages(package, out.mix);
  if (metered) out.metering = meter(package, out.stage->scene(), out.mix, pages);
  if (draws) out.stage->draw(out.camera, out.mix, pages, out.params, progress);
}

Exposure exposure_of(const Rendered& rendered, const ExposureChoice& choice, bool exposed) {
  return exposed ? choice.resolve(rendered.metering) : unit_exposure(rendered.metering.maximum);
}

Vec3 turntable_axis_of(const Stage& stage, const Package& package, const Camera& camera) {
  return stage.view() != nullptr ? turntable_axis(*stage.view(), camera)
                                 : turntable_axis(View(package), camera);
}

/// What only some pictures can be.
void check(const SequenceOptions& sequence, const MixOptions& settings, const std::string& layers,
           const std::string& coverage, const std::string& output, const PictureOptions& picture,
           bool linear) {
  if (linear && picture.device == "software")
    throw UsageError("option '--device'", "software draws no linear picture", "-o FILE.png");
  sequence.check(output);
  if (sequence.fades() && picture.device == "software")
    throw UsageError("option '--device'", "software fades no pictures", "auto, cpu, gl");
  if (sequence.fades() && !settings.preset_file.empty())
    throw UsageError({}, "a fade takes no --preset: --from and --to are its own");
  if (sequence.given() && !(layers.empty() && coverage.empty()))
    throw UsageError({}, "a sequence takes no --layers and --coverage");
  if (layers.empty()) return;
  parse_layers(layers);
  if (!linear) throw UsageError("option '--layers'", "layers need OpenEXR", "-o FILE.exr");
  if (!coverage.empty()) throw UsageError({}, "--layers and --coverage exclude each other");
  if (picture.device != "auto" && picture.device != "cpu")
    throw UsageError("option '--device'", picture.device + " draws no layers", "auto, cpu");
}

/// Both ends of a sequence are one place and one curve.
void check_same(const PictureOptions& from, const PictureOptions& to) {
  if (from.camera != to.camera)
    throw UsageError({}, "the presets have different cameras: --camera NAME decides");
  if (from.tone.mapper().name != to.tone.mapper().name)
    throw UsageError({}, "the presets have different tone curves: --tone NAME decides");
}

}  // namespace

int run_render(int argc, const char* const* argv) {
  const auto start = Clock::now();
  std::string input, output, coverage, layers, colorspace = "rec709";
  MixOptions settings;
  SequenceOptions sequence;
  PictureOptions picture;
  Options options(
      "render",
      "A picture of a package through a camera: base colour x mixed lightmap, visible emitters, "
      "exposure, tone curve.",
      {"sconce render kitchen.sconce window=off ceiling=2700K,50% -o evening.png",
       "sconce render kitchen.sconce --others off lamp=1 --camera stove --turntable 120 -o stove.mp4",
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
  options.option("--layers", &layers,
                 "groups,albedo,normal,position,depth,id: side by side in the OpenEXR; the groups add up to "
                 "the picture; drawn by the CPU");
  options.option("--colorspace", &colorspace, "of an OpenEXR: rec709, acescg");
  sequence.declare(options);
  if (const auto code = options.parse(argc, argv)) return *code;

  const bool tone_given = !picture.tone.curve.empty();
  if (output.empty()) output = default_output(input, ".png");
  check_output(output, {".png", ".exr", ".mp4"});
  if (!coverage.empty()) check_output(coverage, {".exr"});
  if (output == "-" && options.json) throw UsageError({}, "-o - and --json both want standard output");
  const bool linear = lower(fs::path(output).extension().string()) == ".exr";
  const bool acescg = is_acescg(colorspace, linear);
  check(sequence, settings, layers, coverage, output, picture, linear);
  const Preset preset = sequence.fades() ? read_named_preset(sequence.from) : settings.preset();
  PictureOptions last = picture;  // of a sequence
  picture.apply(preset);
  picture.check();
  Preset last_preset;
  if (sequence.fades()) {
    last_preset = read_named_preset(sequence.to);
    last.apply(last_preset);
    last.check();
    check_same(picture, last);
  }
  std::optional<Frames> frames;
  if (sequence.given()) frames.emplace(sequence.open(output));
  const ToneMapper& tone = picture.tone.mapper();
  const ExposureChoice choice = picture.tone.exposure_choice();
  const bool exposed = !linear || choice.explicitly;

  const ThreadLimit threads(options.threads);
  Rendered rendered;
  Exposure exposure;
  std::vector<GroupInfo> groups;
  std::string device;
  std::vector<std::string> files{output};
  {
    const Progress progress = make_progress(options);
    if (linear && tone_given && tone.name != "linear")
      progress.warn("an OpenEXR picture stays linear: --tone " + picture.tone.curve + " is not applied");
    const Package package = settings.open(input);
    groups = package.manifest().groups;
    // Layers are what rays find.
    rendered = open(package, picture, layers.empty() ? picture.device : "cpu",
                    settings.make(preset, groups, progress), progress);
    render(rendered, package, exposed, layers.empty(), progress);
    exposure = exposure_of(rendered, choice, exposed);
    Stage& stage = *rendered.stage;
    device = stage.device();
    if (!coverage.empty()) write_exr(coverage, stage.coverage(), PixelType::half);
    if (sequence.turntable != 0) {
      const Vec3 axis = picture.target.empty() ? turntable_axis_of(stage, package, rendered.camera)
                                               : parse_point(picture.target, "--target");
      const std::vector<Image> pages = mix_pages(package, rendered.mix);
      const auto draw = [&](int frame, const std::string& file) {
        if (frame > 0)
          stage.draw(turned(rendered.camera, axis, frame, sequence.turntable), rendered.mix, pages,
                     rendered.params, progress);
        linear ? write_linear(file, stage.linear(), exposure, acescg)
               : write_png(file, stage.toned(exposure, tone));
      };
      files = write_frames(*frames, sequence.turntable, draw, progress);
    } else if (sequence.fades()) {
      const SequenceEnd from{stage.linear(), exposure};
      rendered.mix = settings.make(last_preset, groups, progress);
      render(rendered, package, exposed, true, progress);
      const SequenceEnd to{stage.linear(), exposure_of(rendered, last.tone.exposure_choice(), exposed)};
      const auto draw = [&](int i, const std::string& file) {
        const SequenceEnd frame = between(from, to, static_cast<double>(i) / (sequence.frames - 1));
        linear ? write_linear(file, frame.linear, frame.exposure, acescg)
               : write_png(file, tone_map(frame.linear, frame.exposure, tone));
      };
      files = write_frames(*frames, sequence.frames, draw, progress);
    } else if (!layers.empty()) {
      const LayeredPicture picture_of_layers = picture_layers(
          package, stage, rendered.camera, rendered.mix, rendered.params, parse_layers(layers), progress);
      write_linear(output, picture_of_layers.image, exposure, acescg, picture_of_layers.light);
    } else {
      linear ? write_linear(output, stage.linear(), exposure, acescg)
             : write_toned(output, stage.toned(exposure, tone));
    }
    rendered.stage.reset();  // before the package
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string exposure_text = exposed ? choice.text() : "none";
  if (options.json) {
    nlohmann::ordered_json report = {
        {"input", input},
        {"output", files.size() > 1 ? nlohmann::ordered_json(files) : nlohmann::ordered_json(output)},
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
    fmt::print("{}: {} x {}, camera {}, exposure {}, {:.1f} s\n",
               files.size() > 1 ? files.front() + " ... " + files.back() : output, rendered.params.width,
               rendered.params.height, rendered.camera.name, exposure_text, seconds);
  }
  if (output != "-") options.next({input});
  return kDone;
}

}  // namespace sconce::app
