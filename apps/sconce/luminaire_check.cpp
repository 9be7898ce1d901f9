// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/sobol.h"
#include "core/text.h"
#include "image/io.h"
#include "light/lamp.h"
#include "luminaire.h"
#include "photometry/diagram.h"
#include "photometry/doctor.h"
#include "photometry/formats.h"
#include "photometry/ugr.h"
#include "scene/groups.h"
#include "scene/shapes.h"
#include "table.h"

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const UgrTable& ugr) {
  std::vector<Table::Column> columns = {{"ROOM"}};
  for (const char* view : {"across", "along"})
    for (const auto& r : UgrTable::kReflectances)
      columns.push_back({fmt::format("{} {:.0f}/{:.0f}/{:.0f}", view, 100 * r[0], 100 * r[1], 100 * r[2]),
                         Table::Align::right});
  Table table(columns);
  for (std::size_t i = 0; i < ugr.values.size(); ++i) {
    std::vector<std::string> cells = {
        fmt::format("{:g}H x {:g}H", UgrTable::kRooms[i].x, UgrTable::kRooms[i].y)};
    for (const double v : ugr.values[i]) cells.push_back(fmt::format("{:.1f}", v));
    table.add(std::move(cells));
  }
  return table.text();
}

constexpr double kStep = 2.5;     // degrees, of a table made of rays or of a light field
constexpr int kDiagramScale = 2;  // pixels per unit of a diagram

/// "13032.0", "3.54": to a tenth, or three digits.
std::string flux_text(double lumens) {
  return lumens < 100 ? fmt::format("{:.3g}", lumens) : fmt::format("{:.1f}", lumens);
}

/// Lamps in folders, in the order of their names; files as they are.
std::vector<std::string> with_folders(const std::vector<std::string>& given) {
  static const std::vector<std::string> kEndings = {".ies", ".ldt", ".gldf", ".tm25ray",
                                                    ".ray", ".sdf", ".dis"};
  std::vector<std::string> out;
  for (const std::string& path : given) {
    if (!std::filesystem::is_directory(path)) {
      out.push_back(path);
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
      if (entry.is_regular_file() &&
          std::ranges::find(kEndings, lower(entry.path().extension().string())) != kEndings.end())
        out.push_back(entry.path().string());
    std::sort(out.begin() + first, out.end());
    if (out.begin() + first == out.end()) throw Error(path, "holds no lamp", join(kEndings, ", "));
  }
  return out;
}

bool is_png(const std::filesystem::path& file) {
  return lower(file.extension().string()) == ".png";
}

std::optional<UgrTable> ugr_of(const Photometry& p) {
  if (!(p.opening.size.x > 0 && p.opening.size.y > 0) || !(flux(p) > 0)) return std::nullopt;
  return ugr_table(p);
}

}  // namespace

double rendered_flux(const Photometry& p) {
  Scene scene;
  add_quad(scene, "dark", add_material(scene, "dark", Rgb(0)), Vec3(-1), Vec3(1, 0, 0), Vec3(0, 1, 0));
  scene.luminaires.push_back({"lamp", p});
  Light light;
  light.intensity = Rgb(1);
  light.shape = LuminaireLight{Id<Luminaire>(0)};
  scene.lights.push_back(light);
  assign_groups(scene, Grouping::one);
  const World world = make_world(scene);
  const Lamps lamps(scene, world);
  const float radius = 1000 * std::max(1.0f, p.opening.radius());
  constexpr uint32_t kPoints = 1 << 18;
  double sum = 0;
  for (uint32_t i = 0; i < kPoints; ++i) {
    const Vec2 u = sobol_pair(i, 0, 1);
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Vec3 d(r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z);
    LightSample sample;
    if (lamps.sample(0, radius * d, sobol_pair(i, 1, 1), sample))
      sum += static_cast<double>(sample.radiance.g * -glm::dot(sample.direction, d));
  }
  return sum / kPoints * 4 * std::numbers::pi * static_cast<double>(radius) * static_cast<double>(radius);
}

int run_luminaire_check(int argc, const char* const* argv) {
  std::vector<std::string> files;
  std::string diagram, isolux;
  double height = 3;
  bool ugr = false, png = false;
  Options options("luminaire check",
                  "A doctor for photometric files: flux stated, integrated and rendered, headers, gaps, "
                  "glare; of rays and light fields their far field. Exit code 3 where "
                  "something is wrong, 1 where a file cannot be read.",
                  {"sconce luminaire check lamp.ldt", "sconce luminaire check lamps/",
                   "sconce luminaire render {FILE} -o wall.png"});
  options.positionals("file", &files, fmt::format("{}; folders: all lamps in them", kAnyLamp), true);
  options.flag("--ugr", &ugr, "print the UGR table of the standard rooms (CIE 117, CIE 190)");
  options.option("--diagram", &diagram, "write the polar diagram, .svg or .png; with several files a folder");
  options.option("--isolux", &isolux,
                 "write lines of equal illuminance on the floor, .svg or .png; with several files a folder");
  options.flag("--png", &png, "diagrams in folders as PNG rather than SVG");
  options.option("--height", &height, "isolux: metres from the lamp down to the floor");
  if (const auto code = options.parse(argc, argv)) return *code;
  files = with_folders(files);
  if (!(height > 0)) throw UsageError("--height", "is not positive", "metres > 0");
  for (const auto& [name, target] : {std::pair("--diagram", &diagram), std::pair("--isolux", &isolux)})
    if (files.size() == 1 && !target->empty() && !is_png(*target) &&
        lower(std::filesystem::path(*target).extension().string()) != ".svg")
      throw UsageError(name, "'" + *target + "' names no format", ".svg, .png");
  std::size_t sick = 0, broken = 0;
  std::map<std::string, int> named;
  Json report = Json::array();
  for (const std::string& target : {diagram, isolux})
    if (!target.empty() && files.size() > 1) std::filesystem::create_directories(target);
  for (const std::string& file : files) {
    std::vector<std::string> said;
    Progress progress = make_progress(options);
    progress.warning = [&](const std::string& line) { said.push_back(line.substr(file.size() + 2)); };
    LuminaireSource source;
    try {
      source = read_luminaire(file, kStep, progress);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      if (files.size() == 1) throw;
      ++broken;
      report.push_back({{"file", file}, {"error", error.what()}});
      std::fflush(stdout);  // in its place among the others, where both go to one file
      fmt::print(stderr, "sconce luminaire check: {}\n", error.what());
      continue;
    }
    const Photometry& p = source.photometry;
    std::vector<Finding> findings = examine(p);
    // Rays and light fields state no flux and are no points: only their far field is one.
    if (source.rays || !source.field.empty())
      std::erase_if(findings, [](const Finding& f) { return !f.warning; });
    // Of a photometric file these are its notes, which are examined.
    if (source.rays)
      for (const std::string& line : said) findings.push_back({true, line});
    if (source.in_watts())
      findings.push_back({true, "its rays are in watts; luminaire convert --lumens makes lumens of them"});
    const double lumens = flux(p), rendered = rendered_flux(p);
    const std::optional<UgrTable> table = ugr_of(p);
    const std::string stem = std::filesystem::path(file).stem().string();
    const int namesakes = named[stem]++;  // files of other folders or formats
    const std::string sheet = namesakes == 0 ? stem : fmt::format("{} {}", stem, namesakes + 1);
    const auto draw = [&](const std::filesystem::path& target, const Drawing& drawing) {
      const bool folder = files.size() > 1;
      const std::filesystem::path to = folder ? target / (sheet + (png ? ".png" : ".svg")) : target;
      if (folder ? png : is_png(to))
        write_png(to, picture_of(drawing, kDiagramScale));
      else
        write_file(to, svg_of(drawing));
    };
    if (!diagram.empty()) draw(diagram, polar_diagram(p, stem));
    if (!isolux.empty()) draw(isolux, isolux_diagram(p, stem, height));
    Json found = Json::array();
    sick += std::ranges::any_of(findings, &Finding::warning) ? 1 : 0;
    for (const Finding& finding : findings) {
      found.push_back({{"warning", finding.warning}, {"text", finding.text}});
    }
    Json entry = {{"file", file},
                  {"lumens", lumens},
                  {"lumens_stated", p.stated ? Json(*p.stated) : Json()},
                  {"lumens_rendered", rendered},
                  {"findings", std::move(found)}};
    if (table) entry["ugr"] = table->values;
    report.push_back(std::move(entry));
    if (options.json || options.quiet) continue;
    const char* unit = source.in_watts() ? "W" : "lm";
    fmt::print("{}: {} {}, rendered {} {}{}\n", file, flux_text(lumens), unit, flux_text(rendered), unit,
               p.stated ? fmt::format(", stated {} lm", flux_text(*p.stated)) : "");
    for (const Finding& finding : findings)
      fmt::print("  {}{}\n", finding.warning ? "warning: " : "", finding.text);
    if (ugr && table)
      fmt::print(
          "  UGR, luminaires a quarter of H apart, {:.0f} lm; reflectances of ceiling/walls/floor, %:\n{}",
          lumens, text_of(*table));
    if (ugr && !table) fmt::print("  no UGR table: the file does not say how large the luminous area is\n");
  }
  if (options.json)
    fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
  else if (!options.quiet && files.size() > 1)
    fmt::print("{} files: {} in order, {} with warnings, {} not read\n", files.size(),
               files.size() - sick - broken, sick, broken);
  if (files.size() == 1) options.next(files);
  return broken > 0 ? kFailed : sick > 0 ? kDiffers : kDone;
}

}  // namespace sconce::app
