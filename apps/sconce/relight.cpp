// SPDX-License-Identifier: Apache-2.0
#include "relight/relight.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "import/lights.h"
#include "mix_options.h"
#include "operator_path.h"
#include "picture_options.h"
#include "picture_output.h"
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

/// What `--light` and `--lights` ask for.
struct Wanted {
  std::vector<Light> lights;
  std::vector<std::string> groups;
};

Wanted find_wanted(const std::vector<std::string>& texts, const std::string& file, const Progress& progress) {
  constexpr std::string_view kGroup = "group,name=";
  Wanted wanted;
  for (const std::string& text : texts) {
    if (text.starts_with(kGroup))
      wanted.groups.push_back(text.substr(kGroup.size()));
    else
      wanted.lights.push_back(light_option(text));
  }
  if (!file.empty())
    for (Light& light : read_lights(file, progress)) wanted.lights.push_back(std::move(light));
  if (wanted.lights.empty() && wanted.groups.empty())
    throw UsageError({}, "no lamp to move: --light or --lights", "--light spot,position=X,Y,Z,lumens=N");
  return wanted;
}

/// Groups that come by transfer leave the lightmap: their weight goes from the mix to their lamps.
std::vector<MovedGroup> take_groups(const Manifest& m, const std::vector<std::string>& names,
                                    MixSpec& lightmap) {
  std::vector<std::string> known;
  for (const GroupInfo& group : m.groups) known.push_back(group.name);
  std::vector<MovedGroup> moved;
  for (const std::string& name : names) {
    const auto it = std::find(known.begin(), known.end(), name);
    if (it == known.end())
      throw UsageError("--light group", "unknown group '" + name + "'" + did_you_mean(name, known),
                       join(known, ", "));
    const auto g = static_cast<std::size_t>(it - known.begin());
    moved.push_back({Id<LightGroup>(g), lightmap.weights[g]});
    lightmap.weights[g] = Rgb(0);
  }
  return moved;
}

struct Relit {
  Image linear;
  Camera camera;
  PictureParams params;
  Metering metering;
  Relighter::Seconds seconds;
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
}

}  // namespace

int run_relight(int argc, const char* const* argv) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string input, output, file;
  std::vector<std::string> texts;
  bool pixels = false;
  MixOptions settings;
  PictureOptions picture;
  Options options(
      "relight",
      "A picture of a package with lamps that are in none of its layers: their direct light as it is, "
      "their indirect light by the operator of 'sconce transfer', beside the baked groups.");
  options.positional("PACKAGE", &input, "NAME.sconce");
  settings.declare(options);
  options.option(
      "--light", &texts,
      "a lamp: point, spot or sun, then keys as in a side file, for example "
      "spot,position=1,2,0,target=0,0,0,lumens=800; or group,name=G: the group by transfer instead of "
      "by its layer; may be given several times");
  options.option("--lights", &file, "TOML file with [[light]] tables");
  options.flag("--pixels", &pixels, "use the operator of --camera's pixels, not the lightmap's");
  picture.declare(options);
  options.option("-o,--output", &output,
                 "PNG (toned), or OpenEXR (linear, cd/m2; exposed only when asked for); - is PNG on stdout "
                 "(default: NAME.relit.png)");
  if (const auto code = options.parse(argc, argv)) return *code;

  const Preset preset = settings.preset();
  picture.apply(preset);
  picture.check();
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
    const Wanted wanted = find_wanted(texts, file, progress);
    const Package package = settings.open(input);
    const Operator op = find_operator(package, pixels ? picture.camera : "");
    const View view(package);
    relit.groups = package.manifest().groups;
    relit.mix = settings.make(preset, relit.groups, progress);
    MixSpec lightmap = relit.mix;
    const std::vector<MovedGroup> groups = take_groups(package.manifest(), wanted.groups, lightmap);
    find_view(op, view, picture, progress, relit);
    progress.check();
    const MovedLamps lamps(view.scene(), view.world(), view.tracer(), wanted.lights, groups);
    const Relighter relighter(package, view, op, lamps);
    relit.seconds = relighter.seconds();
    std::vector<Image> pages = mix_pages(package, lightmap);
    const bool texels = op.kind == OperatorReceivers::texels;
    if (texels) relighter.add_to(pages);
    if (exposed && texels) {
      std::vector<Image> whole = pages;
      relighter.add_direct_to(whole);
      relit.metering = meter(package, view.scene(), relit.mix, whole);
    }
    relit.linear =
        view.render(relit.camera, relit.mix, pages, relit.params, progress, nullptr, relighter.added());
    if (exposed && !texels) relit.metering = meter_picture(relit.linear);
    const Exposure exposure =
        exposed ? choice.resolve(relit.metering) : unit_exposure(relit.metering.maximum);
    linear ? write_linear(output, relit.linear, exposure)
           : write_toned(output, tone_map(relit.linear, exposure, tone));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (options.json) {
    const nlohmann::ordered_json report = {
        {"input", input},
        {"output", output},
        {"width", relit.params.width},
        {"height", relit.params.height},
        {"camera", relit.camera.name},
        {"exposure", exposed ? choice.text() : "none"},
        {"groups", nlohmann::ordered_json::parse(weights_json(relit.groups, relit.mix))},
        {"seconds",
         {{"cloud", relit.seconds.direct}, {"indirect", relit.seconds.indirect}, {"all", seconds}}}};
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet && output != "-") {
    fmt::print("{}: {} x {}, light on the cloud {:.0f} ms, indirect {:.1f} ms, all {:.1f} s\n", output,
               relit.params.width, relit.params.height, 1e3 * relit.seconds.direct,
               1e3 * relit.seconds.indirect, seconds);
  }
  return kDone;
}

}  // namespace sconce::app
