// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "image/io.h"
#include "mix_options.h"
#include "moved_lightmap.h"
#include "picture_options.h"
#include "probe_points.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

constexpr int kPaths = 4096;      // per point
constexpr double kThrift = 1e-4;  // of the power, beside the goals

/// "x,y,z[,nx,ny,nz]=300".
struct PointGoal {
  SurfacePoint at;
  double lux = 0;

  explicit PointGoal(const std::string& text) {
    const std::size_t equals = text.find('=');
    const auto target = parse_number(equals == std::string::npos ? "" : text.substr(equals + 1));
    if (!target || !(*target >= 0))
      throw UsageError("option '--lux'", "'" + text + "' is no goal", "X,Y,Z=LUX or X,Y,Z,NX,NY,NZ=LUX");
    at = parse_probe(text.substr(0, equals), "option '--lux'");
    lux = *target;
  }
};

/// Linear, cd/m2. @param mix  that a display's picture is metered with, where its exposure is not given
Image read_target(const std::string& file, const PictureOptions& picture, const Package& package,
                  const MixSpec& mix, const Progress& progress) {
  const std::string ending = lower(fs::path(file).extension().string());
  if (ending == ".exr" || ending == ".hdr") return read_image(file);
  progress.warn(file + " has no absolute light: taken as exposed, without a tone curve");
  const std::string bytes = read_file(file);
  return from_display(
      decode_image8({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, file),
      kMiddleGrey /
          picture.tone.exposure_choice().resolve(meter(package, mix, mix_pages(package, mix))).scale);
}

}  // namespace

int run_fit(int argc, const char* const* argv) {
  std::string input, target, output;
  std::vector<std::string> points;
  MixOptions settings;
  settings.moves_lamps = true;
  MoveOptions moves;
  PictureOptions picture;
  Options options(
      "fit",
      "Moves the faders to where they come nearest to a picture, or to illuminances at points with "
      "the least power, and writes them as a preset. Colours stay as they are set.",
      {"sconce fit kitchen.sconce --lux 1.2,0.9,0.5=500 -o desk.toml",
       "sconce fit kitchen.sconce --target photo.png -o like-photo.toml",
       "sconce render {PACKAGE} --preset {PRESET}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  settings.declare(options);
  moves.declare(options);
  options.option("--target", &target,
                 "picture to look like: OpenEXR or Radiance in cd/m2; PNG or JPEG as exposed");
  options.option("--lux", &points,
                 "X,Y,Z[,NX,NY,NZ]=LUX: illuminance at a point, facing up unless told otherwise");
  options.option("--camera", &picture.camera, "that the picture was taken with (default: the first)");
  options.option("--eye", &picture.eye, "X,Y,Z in metres, with --target-point");
  options.option("--target-point", &picture.target, "X,Y,Z in metres that --eye looks at");
  options.option("--fov", &picture.fov, "vertical field of view in degrees");
  picture.tone.declare(options);
  options.option("-o,--output", &output, "preset to write (default: standard output)");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (target.empty() && points.empty())
    throw UsageError({}, "nothing to come near to", "--target FILE, --lux X,Y,Z=LUX");
  picture.check();
  std::vector<PointGoal> goals(points.begin(), points.end());
  if (!output.empty()) check_output(output, {".toml"});

  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const auto opened = std::make_shared<const Opened>(settings.open(input));
  const Package& package = opened->package;
  const View& view = opened->rays;
  const std::vector<GroupInfo>& groups = package.manifest().groups;
  Preset start = settings.preset();
  start.assignments.insert(start.assignments.end(), settings.settings.begin(), settings.settings.end());
  if (!settings.others.empty()) start.others = settings.others;
  Faders faders = to_faders(groups, start);
  const std::vector<Rgb> unit = unit_weights(groups, faders);
  Wishes wishes(groups.size());
  std::vector<SurfacePoint> places;
  for (const PointGoal& goal : goals) places.push_back(goal.at);
  const Rearrangement now(moves, start, package, view, progress);
  PointMeter meter = now.meter(places, progress);
  if (!places.empty()) meter.pass(kPaths, progress);
  const auto lux_at = [&](std::size_t i) {
    const std::size_t all = meter.light().groups;
    return std::span(meter.light().values).subspan(i * all, all);
  };
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const std::span<const Rgb> lux = lux_at(i);
    const Rgb given = lux.size() > groups.size() ? lux.back() : Rgb();
    wish_lux(wishes, lux.first(groups.size()), unit, goals[i].lux, static_cast<double>(luminance(given)));
  }
  if (!target.empty()) {
    const MixSpec mix = make_mix(groups, faders);
    const Image wanted = read_target(target, picture, package, mix, progress);
    const Camera camera = picture.find_camera(view.scene(), [&] { return view.camera("", progress); });
    if (now.any()) {
      const MovedLightmap moved(opened, now, progress);
      wish_picture(wishes, moved.view(), moved.light(), camera, unit, wanted, progress);
    } else {
      wish_picture(wishes, view, grouped_light(layers_of(opened)), camera, unit, wanted, progress);
    }
  }
  std::vector<double> power;
  for (const GroupInfo& group : groups) power.push_back(group.lumens);
  const Stopwatch fitting;
  const Fit found = fit(wishes, power, goals.empty() ? 0 : kThrift);
  const double milliseconds = fitting.milliseconds();
  faders = with_gains(faders, found.gains);
  Preset preset = to_preset(groups, faders);
  preset.lamps = now.preset_lamps();
  const std::string text = print_preset(preset);
  if (!output.empty()) write_file(output, text);

  double lumens = 0;
  nlohmann::ordered_json reached = nlohmann::ordered_json::array();
  for (std::size_t g = 0; g < groups.size(); ++g) lumens += groups[g].lumens * found.gains[g];
  MixSpec mix = make_mix(groups, faders);
  if (now.adds()) mix.weights.emplace_back(1.0f);
  for (std::size_t i = 0; i < goals.size(); ++i)
    reached.push_back(
        {{"wanted", goals[i].lux}, {"lux", static_cast<double>(luminance(meter.light().mixed(i, mix)))}});
  if (options.json) {
    const nlohmann::ordered_json report = {
        {"input", input},
        {"output", output},
        {"residual", found.residual},
        {"lumens", lumens},
        {"points", reached},
        {"milliseconds", milliseconds},
        {"groups", nlohmann::ordered_json::parse(weights_json(groups, mix))}};
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    if (output.empty()) fmt::print("{}", text);
    if (!options.quiet) {
      for (const auto& point : reached)
        fmt::print("# {:.0f} lx wanted, {:.1f} lx reached\n", point["wanted"].get<double>(),
                   point["lux"].get<double>());
      fmt::print("# residual {:.2f} %, {:.0f} lm\n", 100 * found.residual, lumens);
    }
  }
  if (!output.empty()) options.next({input, output});
  return kDone;
}

}  // namespace sconce::app
