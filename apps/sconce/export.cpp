// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "mix_options.h"
#include "move_options.h"
#include "session/to_scene.h"
#include "web_site.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// What would be replaced must be such a page itself.
void check_folder(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw Error(folder.string(), "is no folder");
  if (!fs::is_empty(folder) && !fs::exists(folder / "scene" / web::kSiteFile))
    throw Error(folder.string(), "holds something else", "a new or empty folder, or an earlier export");
}

int export_scene(const std::string& input, const std::string& target, const MixOptions& settings,
                 const MoveOptions& moves, const Options& options) {
  check_output(target, {".glb"});
  if (target == "-") throw UsageError("option '--scene'", "standard output takes one file", "NAME.glb");
  const Progress progress = make_progress(options);
  const Package package = settings.open(input);
  const Preset preset = settings.preset();
  const MixSpec mix = settings.make(preset, package.manifest().groups, progress);
  const View home(package);
  const Rearrangement now(moves, preset, package, home, progress);
  for (const Rearrangement::Shader& shader : now.shaders()) progress.warn(shader_left_out(shader.lamp.name));
  Scene scene = relit_scene(now.scene(), mix);
  append(scene, now.added());
  const SceneFiles written = write_scene(target, std::move(scene), package.manifest().generator);
  for (const std::string& warning : written.warnings) progress.warn(warning);
  std::vector<std::string> files;
  for (const fs::path& file : written.files) files.push_back(file.string());
  if (options.json)
    fmt::print("{}\n",
               nlohmann::ordered_json{
                   {"input", input},
                   {"output", files},
                   {"groups", nlohmann::ordered_json::parse(weights_json(package.manifest().groups, mix))}}
                   .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  else if (!options.quiet)
    fmt::print("{}: the scene, lit as mixed\n", join(files, ", "));
  return kDone;
}

}  // namespace

int run_export(int argc, const char* const* argv) {
  std::string input, folder, scene;
  MixOptions settings;
  settings.moves_lamps = true;
  MoveOptions moves;
  WebOptions web;
  Options options(
      "export",
      "A package as a web page with faders: a folder that any web server can host, without code on "
      "the server; or as a scene again, its lamps and emitters as strong and coloured as they are mixed, "
      "lamps and objects where --move and --object put them.",
      {"sconce export kitchen.sconce ceiling=0.3 --scene relit.glb",
       "sconce export kitchen.sconce --web site --preset evening.toml",
       "python3 -m http.server -d {FOLDER}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  options.option("--web", &folder, "folder to write; an earlier export in its place is replaced");
  options.option("--scene", &scene,
                 "NAME.glb to write the re-lit scene to, and NAME.toml with its sky; what --light to "
                 "--object say is in it, "
                 "but for light shaders");
  web.declare(options);
  options.positionals("GROUP=SETTING", &settings.settings,
                      "with --scene: the mix, as `sconce render` takes it");
  options.option("--others", &settings.others, "with --scene: setting of every group that is not named");
  moves.declare(options);
  if (const auto code = options.parse(argc, argv)) return *code;
  if (folder.empty() == scene.empty())
    throw UsageError({}, folder.empty() ? "nothing to export to" : "a page and a scene are two exports",
                     "--web DIR or --scene NAME.glb");
  const ThreadLimit threads(options.threads);
  if (!scene.empty()) {
    if (web.presets.size() > 1) throw UsageError("option '--preset'", "a scene has one mix", "one preset");
    if (!web.presets.empty()) settings.preset_file = web.presets.front();
    return export_scene(input, scene, settings, moves, options);
  }
  if (!settings.settings.empty() || !settings.others.empty())
    throw UsageError({}, "a page has its own faders", "settings with --scene, or --preset FILE");
  if (moves.any())
    throw UsageError({}, "a page has lamps and objects where they were baked", "--scene NAME.glb");
  web.check();

  fs::path target = fs::absolute(folder).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();
  check_folder(target);
  web::SiteReport report;
  {
    const Progress progress = make_progress(options);
    Beside beside(target);
    report = write_web_site(input, beside.path(), web, progress);
    beside.commit();
  }
  if (options.json) {
    nlohmann::ordered_json json = {{"input", input},
                                   {"output", folder},
                                   {"bytes",
                                    {{"geometry", report.geometry},
                                     {"textures", report.textures},
                                     {"meter", report.meter},
                                     {"layers", nlohmann::ordered_json::object()}}}};
    for (const auto& tier : report.tiers) json["bytes"]["layers"][std::string(tier.name)] = tier.bytes;
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet) {
    std::string layers;
    for (const auto& tier : report.tiers)
      layers += fmt::format("{}{} {:.1f} MB", layers.empty() ? "" : ", ", tier.name,
                            static_cast<double>(tier.bytes) / 1e6);
    fmt::print("{}: a page for any web server; layers: {}; the rest {:.1f} MB\n", folder, layers,
               static_cast<double>(report.geometry + report.textures + report.meter) / 1e6);
  }
  options.next({folder});
  return kDone;
}

}  // namespace sconce::app
