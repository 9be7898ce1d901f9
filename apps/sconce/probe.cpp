// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "image/io.h"
#include "mix_options.h"
#include "move_options.h"
#include "probe_report.h"
#include "scene/daylight.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Probing {
  std::string input, file, plane, output;
  std::vector<std::string> points;
  double grid = 0.5, maintenance = 1;
  int samples = 2048;
  bool from_probes = false;
};

/// What the skies put onto an open horizontal plane, lux, and the groups that they are in.
double outside(const Scene& scene, const MixSpec& mix, std::vector<bool>& skies) {
  double lux = 0;
  for (const Light& light : scene.lights) {
    const auto* sky = std::get_if<SkyLight>(&light.shape);
    if (sky == nullptr || !light.group) continue;
    skies[light.group.value] = true;
    const Rgb weight = mix.weights[light.group.value] * light.intensity;
    const Image& image = sky->image;
    lux += image.data.empty() ? static_cast<double>(kPi * luminance(weight))
                              : horizontal_illuminance(image) * static_cast<double>(luminance(weight));
  }
  return lux;
}

ProbePoints find_points(const Probing& job, const Bounds& bounds, const std::vector<MeasuredPlane>& baked) {
  ProbePoints at;
  if (!job.plane.empty()) {
    std::vector<std::string> names;
    for (const MeasuredPlane& plane : baked) names.push_back(plane.name);
    at.plane = parse_plane(job.plane, bounds, job.grid, names);
    at.points = at.plane->points();
    return at;
  }
  if (!job.file.empty()) at.points = read_probes(job.file);
  for (const std::string& text : job.points) at.points.push_back(parse_probe(text, "option '--at'"));
  if (at.points.empty()) throw UsageError({}, "there are no points", "--at, --points, --plane");
  return at;
}

/// What was measured, and how in words.
struct Measured {
  MeasuredLight light;
  std::string how;
};

/// From the package where the plane or the probes were baked with it and nothing has moved, else traced.
Measured measure(const Probing& job, const Package& package, const View& home, const Rearrangement& now,
                 ProbePoints& at, const Progress& progress) {
  const std::size_t groups = package.manifest().groups.size();
  const std::vector<MeasuredPlane> planes =
      job.plane.empty() ? std::vector<MeasuredPlane>() : baked_planes(package);
  for (const MeasuredPlane& baked : planes) {
    if (baked.name != job.plane) continue;
    at.plane = baked.grid;
    at.points = baked.grid.points();
    if (!now.any())
      return {baked.light,
              fmt::format("path tracing, all bounces, diffuse surfaces, baked with up to {} paths a point",
                          baked.light.samples)};
  }
  if (!at.plane) at = find_points(job, home.world().bounds, planes);
  if (job.from_probes) {
    const std::optional<ProbeGrid> probes = read_probes(package);
    if (!probes) throw Error(job.input, "has no probes", "sconce bake --probes 1");
    MeasuredLight light{groups, 0, {}};
    for (const SurfacePoint& p : at.points)
      for (std::size_t g = 0; g < groups; ++g)
        light.values.push_back(facing(probes->at(p.position, g), p.shading_normal));
    return {std::move(light), fmt::format("between probes {:.3g} m apart", probes->spacing)};
  }
  PointMeter meter = now.meter(at.points, progress);
  meter.pass(job.samples, progress);
  return {meter.light(), fmt::format("path tracing, all bounces, diffuse surfaces, {} paths a point",
                                     meter.light().samples)};
}

void fill_values(ProbeReport& report, const MeasuredLight& light, const MixSpec& mix, const Scene& scene,
                 float maintenance) {
  const std::size_t count = light.points();
  std::vector<bool> skies(light.groups);
  const double open = outside(scene, mix, skies);
  report.parts.assign(light.groups, std::vector<float>(count));
  const std::vector<uint8_t> dark = report.at.plane ? unreached(light) : std::vector<uint8_t>(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    float sky = 0;
    for (std::size_t g = 0; g < light.groups; ++g) {
      report.parts[g][i] = maintenance * luminance(mix.weights[g] * light.values[i * light.groups + g]);
      if (skies[g]) sky += report.parts[g][i] / maintenance;
    }
    const Rgb e = light.mixed(i, mix);  // between probes a group's part may be below 0, light is not
    report.colors.push_back(maintenance * Rgb(std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f)));
    report.lux.push_back(dark[i] ? NAN : luminance(report.colors.back()));
    if (open > 0) report.daylight.push_back(static_cast<float>(100 * static_cast<double>(sky) / open));
  }
}

nlohmann::ordered_json json_of(const LuxStatistics& s) {
  return {{"minimum", s.minimum},
          {"average", s.average},
          {"maximum", s.maximum},
          {"uniformity", s.uniformity()},
          {"diversity", s.diversity()}};
}

void print(const ProbeReport& report, const Probing& job, const Options& options) {
  const LuxStatistics all = report.statistics(report.lux);
  if (options.json) {
    nlohmann::ordered_json json = {
        {"input", job.input}, {"output", job.output}, {"points", report.lux.size()}, {"lux", json_of(all)}};
    if (!report.daylight.empty())
      json["daylight_factor_percent"] = json_of(report.statistics(report.daylight));
    for (std::size_t g = 0; g < report.groups.size(); ++g)
      json["groups"].push_back(
          {{"name", report.groups[g]}, {"lux", json_of(report.statistics(report.parts[g]))}});
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet) {
    const auto line = [](std::string_view name, const LuxStatistics& s, const char* unit) {
      fmt::print("{:<16}min {:.4g} {}, average {:.4g} {}, max {:.4g} {}, U0 {:.2f}, Ud {:.2f}\n", name,
                 s.minimum, unit, s.average, unit, s.maximum, unit, s.uniformity(), s.diversity());
    };
    fmt::print("{} points\n", report.lux.size());
    line("all light", all, "lx");
    if (!report.daylight.empty()) line("daylight factor", report.statistics(report.daylight), "%");
    for (std::size_t g = 0; g < report.groups.size(); ++g)
      line("  " + report.groups[g], report.statistics(report.parts[g]), "lx");
  }
}

}  // namespace

int run_probe(int argc, const char* const* argv) {
  Probing job;
  MixOptions settings;
  settings.moves_lamps = true;
  MoveOptions moves;
  Options options(
      "probe",
      "Lux at points or on a plane, of every light group and of their mix: all bounces, traced to the "
      "points. Figures are rounded as Monte Carlo noise of --samples paths makes sense of.",
      {"sconce probe kitchen.sconce --at 1.2,0.9,0.5 ceiling=40%",
       "sconce probe kitchen.sconce --plane floor+0.75 -o floor.html",
       "sconce fit {PACKAGE} --lux 1.2,0.9,0.5=500 -o desk.toml"});
  options.positional("PACKAGE", &job.input, "NAME.sconce");
  settings.declare(options);
  moves.declare(options);
  options.option("--at", &job.points, "X,Y,Z[,NX,NY,NZ]: a point in metres, facing up unless told otherwise");
  options.option(
      "--points", &job.file,
      "file of such points, one a line with spaces between; - is standard input, and then R G B in lux "
      "a line is what is written, as rtrace -I does");
  options.option(
      "--plane", &job.plane,
      "floor+0.75: horizontal over the scene, half a metre from its sides; or a corner and two edges, "
      "X,Y,Z/AX,AY,AZ/BX,BY,BZ; or the name of one that was baked ([[plane]] of the side file), which is "
      "only read");
  options.option("--grid", &job.grid, "metres between the points of a plane that is traced, at most");
  options.option("--samples", &job.samples, "paths per point");
  options.flag("--probes", &job.from_probes,
               "read between the package's probes (bake --probes) instead of tracing, as an engine does");
  options.option("--maintenance", &job.maintenance,
                 "maintenance factor: multiplies all lux, not daylight factors");
  options.option(
      "-o,--output", &job.output,
      "table (.csv), page with picture, table and assumptions (.html), or the plane in false colours (.png)");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (!job.plane.empty() && (!job.points.empty() || !job.file.empty()))
    throw UsageError("option '--plane'", "stands beside points", "one of --plane, --at with --points");
  if (!(job.grid > 0)) throw UsageError("option '--grid'", "is not positive", "metres");
  if (job.samples < 1) throw UsageError("option '--samples'", "is not positive");
  if (!(job.maintenance > 0 && job.maintenance <= 1))
    throw UsageError("option '--maintenance'", "is out of range", "0 exclusive to 1");
  if (!job.output.empty()) check_output(job.output, {".csv", ".html", ".png"});
  const std::string ending = lower(fs::path(job.output).extension().string());
  if (ending == ".png" && job.plane.empty())
    throw UsageError("option '--output'", "a picture needs --plane", ".csv, .html");

  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const Package package = settings.open(job.input);
  const std::vector<GroupInfo>& groups = package.manifest().groups;
  const Preset preset = settings.preset();
  MixSpec mix = settings.make(preset, groups, progress);
  const View view(package);
  const Rearrangement now(moves, preset, package, view, progress);
  if (now.any() && job.from_probes)
    throw UsageError("option '--probes'", "probes know lamps and objects where they were baked",
                     "--probes without --light, --move, --kind, --object");
  ProbeReport report;
  for (const GroupInfo& group : groups) report.groups.push_back(group.name);
  if (now.adds()) report.groups.emplace_back(kAddedGroup), mix.weights.emplace_back(1.0f);
  const Measured measured = measure(job, package, view, now, report.at, progress);
  fill_values(report, measured.light, mix, view.scene(), static_cast<float>(job.maintenance));
  report.assumptions = {{"package", fs::path(job.input).filename().string()},
                        {"settings", settings.settings.empty() ? "as baked" : join(settings.settings, " ")},
                        {"preset", settings.preset_file.empty() ? "none" : settings.preset_file},
                        {"lamps and objects", now.any() ? moves.text() : "where they were baked"},
                        {"maintenance factor", fmt::format("{:.2f}", job.maintenance)},
                        {"calculation", measured.how},
                        {"plane", job.plane.empty() ? "none: single points" : job.plane}};
  if (job.output == "-" || ending == ".csv") {
    job.output == "-" ? write_stdout(probe_csv(report)) : write_file(job.output, probe_csv(report));
  } else if (ending == ".html") {
    write_file(job.output, probe_html(report));
  } else if (ending == ".png") {
    write_png(job.output, probe_picture(report));
  }
  if (job.file == "-" && job.output.empty())
    write_stdout(probe_lines(report));
  else if (job.output != "-")
    print(report, job, options), options.next({job.input});
  return kDone;
}

}  // namespace sconce::app
