// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "mix_options.h"
#include "move_options.h"
#include "picture/gloss.h"
#include "picture_options.h"
#include "picture_output.h"
#include "relight/package_operator.h"
#include "relight/texel_light.h"
#include "relight_stage.h"
#include "tone/apply.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Relit {
  Image linear;
  Camera camera;
  PictureParams params;
  Metering metering;
  Relighter::Seconds seconds;
  Culling::Report culled;
  std::string device;
  std::vector<GroupInfo> groups;
  MixSpec mix;
};

/// The camera and size of an operator for pixels are its own.
void find_view(const Operator& op, const View& view, const PictureOptions& picture, bool lobes,
               const Progress& progress, Relit& out) {
  if (op.kind == OperatorReceivers::texels) {
    out.camera = picture.find_camera(view.scene(), [&] { return view.camera("", progress); });
    out.params = picture.params(out.camera);
    return;
  }
  out.camera.name = op.camera;
  out.camera.frame = op.camera_frame;
  out.camera.yfov = op.camera_yfov;
  out.params.width = op.width, out.params.height = op.height;
  out.params.samples = picture.samples;
  if (picture.no_reflections) return;
  if (lobes)
    out.params.reflections = kReflections;
  else if (view.scene().has_mirrors())
    progress.warn(
        "an operator for pixels that has no lobes shows no reflections: --no-reflections is silent");
}

}  // namespace

int run_relight(int argc, const char* const* argv) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string input, output;
  MoveOptions moves;
  bool pixels = false;
  double cull = 0;
  MixOptions settings;
  settings.moves_lamps = true;
  PictureOptions picture;
  RelightDevice device;
  Options options(
      "relight",
      "A picture of a package with lamps that are in none of its layers: their direct light as it is, "
      "their indirect light by the operator of 'sconce transfer', beside the baked groups.",
      {"sconce relight kitchen.sconce --light point,position=1,1.8,1,lumens=400 -o lamp.png",
       "sconce relight kitchen.sconce --move pendant=1,1.9,1 --object chair=1.2,0.45,0.3",
       "sconce view {PACKAGE}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  settings.declare(options);
  moves.declare(options, true);
  options.flag("--pixels", &pixels, "use the operator of --camera's pixels, not the lightmap's");
  picture.declare(options);
  options.option(
      "--cull", &cull,
      "leave out wavelet coefficients of the cloud's light that change indirect light by less than "
      "this share of what its mean does, for example 0.001; what that can change at most is told");
  options.option("--patches", &device.patches, "small lamps that OpenGL draws a lamp with an area as");
  options.option("--shadow-map", &device.shadow_side, "texels of the side of OpenGL's shadow maps");
  options.option("--terms-per-pass", &device.terms_per_pass,
                 "terms of a light field that OpenGL lights in one pass; 0 = all");
  options.flag("--srgbe", &device.srgbe,
               "sum these passes in 8 bits with a shared exponent, for devices without float buffers");
  options.option("-o,--output", &output,
                 "PNG (toned), or OpenEXR (linear, cd/m2; exposed only when asked for); - is PNG on stdout "
                 "(default: NAME.relit.png)");
  if (const auto code = options.parse(argc, argv)) return *code;

  const Preset preset = settings.preset();
  picture.apply(preset);
  picture.check();
  if (picture.tier != "auto") throw UsageError({}, "--tier is for 'sconce render'");
  device.name = picture.device;
  device.check();
  if (!(cull >= 0 && cull <= 1)) throw UsageError("option '--cull'", fmt::format("{}", cull), "0 to 1");
  if (pixels && picture.camera.empty()) throw UsageError({}, "--pixels needs --camera");
  if (pixels && !moves.objects.empty()) throw UsageError({}, "--object needs the lightmap, not --pixels");
  if (pixels && !picture.size.empty()) throw UsageError({}, "--size is the operator's with --pixels");
  if (output.empty()) output = default_output(input, ".relit.png");
  check_output(output, {".png", ".exr"});
  if (output == "-" && options.json) throw UsageError({}, "-o - and --json both want standard output");
  const bool linear = lower(fs::path(output).extension().string()) == ".exr";
  const ToneMapper& tone = picture.tone.mapper();
  const ExposureChoice choice = picture.tone.exposure_choice();
  const bool exposed = !linear || choice.explicitly;

  const ThreadLimit threads(options.threads);
  Relit relit;
  {
    const Progress progress = make_progress(options);
    const std::vector<ObjectPlace> places = moves.places();
    const WantedLamps wanted = moves.lamps.parse(preset, progress, places.empty());
    const Package package = settings.open(input);
    std::optional<Operator> own_operator;  // missing, it is told before the scene is read
    if (places.empty()) own_operator = find_operator(package, pixels ? picture.camera : "");
    const View home(package);
    const auto elsewhere =
        places.empty() ? nullptr : std::make_unique<ObjectsElsewhere>(package, home, places, progress);
    const View& view = elsewhere ? elsewhere->view() : home;
    const Operator op = elsewhere ? elsewhere->transfer() : *std::move(own_operator);
    const std::optional<Operator> lobes =
        pixels && !picture.no_reflections ? find_lobes(package, op) : std::nullopt;
    device.reflections = !picture.no_reflections && (!pixels || lobes);
    relit.groups = package.manifest().groups;
    relit.mix = settings.make(preset, relit.groups, progress);
    MixSpec lightmap = relit.mix;
    const bool texels = op.kind == OperatorReceivers::texels;
    const Lamps own(view.scene(), view.world());
    const RelitLamps lit = place_lamps(wanted, view.scene(), own, !texels, lightmap, progress);
    find_view(op, view, picture, lobes.has_value(), progress, relit);
    progress.check();
    const auto lamps_at = [&](const MoreLights& more, std::span<const MovedGroup> of,
                              std::span<const LampMove> by) {
      return MovedLamps(view.scene(), view.world(), view.tracer(), more, of, by);
    };
    const MovedLamps lamps = lamps_at(lit.more, lit.shining, lit.moves);
    RelightJob job{
        package, view, op, lamps, lit.shaders, nullptr, static_cast<float>(cull), lobes ? &*lobes : nullptr};
    std::vector<Image> pages = mix_pages(package, lightmap), components;
    if (elsewhere)
      elsewhere->add_to(pages, lightmap);
    else if (view.sees_normal_maps())
      components = mix_components(package, lightmap);
    if (const std::vector<MovedGroup> parts = in_part(lit.left); !parts.empty()) {
      job.bounces = std::make_shared<FoldedBounces>(op);
      take_share(package_atlas(package, view), op,
                 lightmap_share(package, view, op, *job.bounces, lamps_at({}, parts, {}), progress), pages);
    }
    const auto stage = make_relight_stage(job, device, progress);
    relit.seconds = stage->seconds();
    relit.device = stage->device();
    if (cull > 0) relit.culled = stage->culled();
    if (texels) stage->add_to(pages);
    relit.linear = stage->draw(relit.camera, relit.mix, pages, components, relit.params, progress);
    if (exposed && texels && lit.shaders.empty()) {
      add_to_pages(package, view, op, direct_at_middles(op, lamps), pages);
      relit.metering = meter(package, view.scene(), relit.mix, pages);
    } else if (exposed) {
      relit.metering = meter_picture(relit.linear);
    }
    const Exposure exposure =
        exposed ? choice.resolve(relit.metering) : unit_exposure(relit.metering.maximum);
    linear ? write_linear(output, relit.linear, exposure)
           : write_toned(output, tone_map(relit.linear, exposure, tone));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (options.json) {
    nlohmann::ordered_json report = {
        {"input", input},
        {"output", output},
        {"width", relit.params.width},
        {"height", relit.params.height},
        {"camera", relit.camera.name},
        {"device", relit.device},
        {"exposure", exposed ? choice.text() : "none"},
        {"groups", nlohmann::ordered_json::parse(weights_json(relit.groups, relit.mix))},
        {"seconds",
         {{"cloud", relit.seconds.direct}, {"indirect", relit.seconds.indirect}, {"all", seconds}}}};
    if (cull > 0)
      report["culled"] = {{"coefficients", relit.culled.culled},
                          {"of", relit.culled.of},
                          {"largest_error", relit.culled.bound}};
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet && output != "-") {
    fmt::print("{}: {} x {}, light on the cloud {:.0f} ms, indirect {:.1f} ms, all {:.1f} s\n", output,
               relit.params.width, relit.params.height, 1e3 * relit.seconds.direct,
               1e3 * relit.seconds.indirect, seconds);
    if (cull > 0)
      fmt::print("culled: {} of {} coefficients; indirect light is wrong by {:.2g} % (RMS) at most\n",
                 relit.culled.culled, relit.culled.of, 100 * relit.culled.bound);
  }
  if (output != "-") options.next({input});
  return kDone;
}

}  // namespace sconce::app
