// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "import/lights.h"
#include "mix_options.h"
#include "picture_options.h"
#include "picture_output.h"
#include "relight/package_operator.h"
#include "relight/texel_light.h"
#include "relight_stage.h"
#include "shader_lamp.h"
#include "tone/apply.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// A lamp's text; what a file would call an error is here a wrong use. @throws UsageError
Light light_option(const std::string& text) {
  try {
    return parse_light(text, "--light " + text);
  } catch (const Error& e) {
    throw UsageError({}, e.what());
  }
}

struct Move {
  std::string name;
  LampPlace to;
};

/// `LAMP=X,Y,Z`, and `,target=X,Y,Z` after it. @throws UsageError
Move parse_move(const std::string& text) {
  constexpr std::string_view kTarget = ",target=";
  const std::size_t target = text.rfind(kTarget);
  const std::string place = text.substr(0, target);
  const std::size_t equals = place.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("option '--move'", "'" + text + "' is not understood", "LAMP=X,Y,Z[,target=X,Y,Z]");
  Move move{place.substr(0, equals), {parse_point(place.substr(equals + 1), "--move"), {}}};
  if (target != std::string::npos)
    move.to.target = parse_point(text.substr(target + kTarget.size()), "--move");
  return move;
}

/// What `--light`, `--lights` and `--move` ask for.
struct Wanted {
  std::vector<Light> lights;
  std::vector<gpu::LampShader> shaders;
  std::vector<std::string> groups;
  std::vector<Move> moves;
};

Wanted find_wanted(const std::vector<std::string>& texts, const std::string& file,
                   const std::vector<std::string>& moves, const Progress& progress) {
  constexpr std::string_view kGroup = "group,name=";
  Wanted wanted;
  for (const std::string& text : texts) {
    if (text.starts_with(kGroup))
      wanted.groups.push_back(text.substr(kGroup.size()));
    else if (text.starts_with(kShaderLamp))
      wanted.shaders.push_back(parse_shader_lamp(text));
    else
      wanted.lights.push_back(light_option(text));
  }
  if (!file.empty())
    for (Light& light : read_lights(file, progress)) wanted.lights.push_back(std::move(light));
  for (const std::string& text : moves) wanted.moves.push_back(parse_move(text));
  if (wanted.lights.empty() && wanted.groups.empty() && wanted.moves.empty() && wanted.shaders.empty())
    throw UsageError({}, "no lamp to move: --light, --lights or --move",
                     "--light spot,position=X,Y,Z,lumens=N; --move LAMP=X,Y,Z");
  return wanted;
}

/// The group of that name. @throws UsageError
Id<LightGroup> find_group(const Manifest& m, const std::string& name) {
  std::vector<std::string> known;
  for (const GroupInfo& group : m.groups) known.push_back(group.name);
  const auto it = std::find(known.begin(), known.end(), name);
  if (it == known.end())
    throw UsageError("--light group", "unknown group '" + name + "'" + did_you_mean(name, known),
                     join(known, ", "));
  return Id<LightGroup>(static_cast<std::size_t>(it - known.begin()));
}

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
void find_view(const Operator& op, const View& view, const PictureOptions& picture, const Progress& progress,
               Relit& out) {
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
  // Its light is known where its pixels look, not where mirrors do.
  if (!picture.no_reflections && view.scene().has_mirrors())
    progress.warn("an operator for pixels shows no reflections: --no-reflections is silent");
}

}  // namespace

int run_relight(int argc, const char* const* argv) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string input, output, file;
  std::vector<std::string> texts, moves;
  bool pixels = false;
  double cull = 0;
  MixOptions settings;
  PictureOptions picture;
  RelightDevice device;
  Options options(
      "relight",
      "A picture of a package with lamps that are in none of its layers: their direct light as it is, "
      "their indirect light by the operator of 'sconce transfer', beside the baked groups.",
      {"sconce relight kitchen.sconce --light point,position=1,1.8,1,lumens=400 -o lamp.png",
       "sconce relight kitchen.sconce --move pendant=1,1.9,1 --others off", "sconce view {PACKAGE}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  settings.declare(options);
  options.option(
      "--light", &texts,
      "a lamp: point, spot or sun, then keys as in a side file, for example "
      "spot,position=1,2,0,target=0,0,0,lumens=800; or group,name=G: the group by transfer instead of "
      "by its layer; or shader,file=F.glsl,position=X,Y,Z,UNIFORM=VALUE,...: a light of your own, by OpenGL; "
      "may "
      "be given several times");
  options.option("--lights", &file, "TOML file with [[light]] tables");
  options.option(
      "--move", &moves,
      "LAMP=X,Y,Z[,target=X,Y,Z]: a lamp or a whole group of the package leaves its layer and shines "
      "from there, turned to the target; may be given several times");
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
  device.reflections = !picture.no_reflections && !pixels;
  device.check();
  if (!(cull >= 0 && cull <= 1)) throw UsageError("option '--cull'", fmt::format("{}", cull), "0 to 1");
  if (pixels && picture.camera.empty()) throw UsageError({}, "--pixels needs --camera");
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
    const Wanted wanted = find_wanted(texts, file, moves, progress);
    const Package package = settings.open(input);
    const Operator op = find_operator(package, pixels ? picture.camera : "");
    const View view(package);
    relit.groups = package.manifest().groups;
    relit.mix = settings.make(preset, relit.groups, progress);
    MixSpec lightmap = relit.mix;
    std::vector<Id<LightGroup>> left;
    for (const std::string& name : wanted.groups) left.push_back(find_group(package.manifest(), name));
    const Lamps own(view.scene(), view.world());
    std::vector<LampMove> moved;
    for (const Move& move : wanted.moves)
      moved.push_back(find_move(view.scene(), own, move.name, move.to, "option '--move'"));
    const bool texels = op.kind == OperatorReceivers::texels;
    const std::vector<MovedGroup> groups = take_lamps(own, left, moved, !texels, lightmap);
    find_view(op, view, picture, progress, relit);
    progress.check();
    const auto lamps_at = [&](const std::vector<Light>& lights, std::span<const MovedGroup> of,
                              std::span<const LampMove> by) {
      return MovedLamps(view.scene(), view.world(), view.tracer(), lights, of, by);
    };
    const MovedLamps lamps = lamps_at(wanted.lights, groups, moved);
    RelightJob job{package, view, op, lamps, wanted.shaders, nullptr, static_cast<float>(cull)};
    std::vector<Image> pages = mix_pages(package, lightmap), components;
    if (view.sees_normal_maps()) components = mix_components(package, lightmap);
    if (const std::vector<MovedGroup> parts = in_part(groups); !parts.empty()) {
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
    if (exposed && texels && wanted.shaders.empty()) {
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
