// SPDX-License-Identifier: Apache-2.0
#include "init.h"

#include <fmt/format.h>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/import.h"
#include "package/glb.h"
#include "photometry/formats.h"
#include "scene/groups.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// `8x6x2.8` or `70/50/20`. @throws UsageError naming the option
std::vector<float> numbers(const std::string& text, char separator, std::size_t count, float least,
                           float most, const std::string& option, const std::string& form) {
  std::vector<float> out;
  for (const std::string& part : split(text, separator)) {
    const auto value = parse_number(trim(part));
    if (!value || !(*value >= static_cast<double>(least) && *value <= static_cast<double>(most))) break;
    out.push_back(static_cast<float>(*value));
  }
  if (out.size() != count) throw UsageError("option '" + option + "'", "'" + text + "' does not fit", form);
  return out;
}

void must_be_new(const fs::path& path, bool force) {
  if (!force && fs::exists(path)) throw Error(path.string(), "is there already", "--force to write over it");
}

struct Request {
  std::string scene, size, reflectance = "70/50/20", luminaire, count = "1x1", output;
  double mount = 0;
  bool force = false;
};

RoomRequest parse_room(const Request& given) {
  RoomRequest room;
  const auto size =
      numbers(given.size, 'x', 3, 0.1f, 1000, "--room", "WIDTHxDEPTHxHEIGHT in metres, 8x6x2.8");
  room.size = {size[0], size[2], size[1]};
  const auto reflectance =
      numbers(given.reflectance, '/', 3, 0, 98, "--reflectance", "CEILING/WALLS/FLOOR in percent, 70/50/20");
  room.ceiling = reflectance[0] / 100, room.walls = reflectance[1] / 100, room.floor = reflectance[2] / 100;
  const auto count =
      numbers(given.count, 'x', 2, 1, 1000, "--count", "COLUMNSxROWS along width and depth, 3x4");
  room.columns = static_cast<int>(count[0]), room.rows = static_cast<int>(count[1]);
  room.luminaire = given.luminaire;
  room.mount = static_cast<float>(given.mount);
  if (!(room.mount >= 0 && room.mount <= room.size.y))
    throw UsageError("option '--mount'", "is out of the room", "metres above the floor");
  return room;
}

int init_room(const Request& given, const Options& options) {
  const RoomRequest room = parse_room(given);
  const fs::path scene = fs::path(given.output.empty() ? "room.glb" : given.output).replace_extension(".glb");
  const fs::path side = fs::path(scene).replace_extension(".toml");
  fs::path lamp;
  std::string photometry;
  if (!room.luminaire.empty()) {
    photometry = read_file(room.luminaire);
    read_photometry(room.luminaire);  // tells what is wrong with it now
    lamp = scene.parent_path() / fs::path(room.luminaire).filename();
  }
  must_be_new(scene, given.force), must_be_new(side, given.force);
  if (!lamp.empty() && !(fs::exists(lamp) && fs::equivalent(lamp, room.luminaire))) {
    must_be_new(lamp, given.force);
    write_file(lamp, photometry);
  }
  write_file(scene, write_glb(make_room(room), "sconce"));
  write_file(side, room_side_file(room, scene.filename().string()));
  if (!options.quiet) fmt::print("{} and {}\n", scene.string(), side.string());
  options.next({scene.string()});
  return kDone;
}

}  // namespace

int run_init(int argc, const char* const* argv) {
  Request given;
  Options options(
      "init",
      "Writes a commented side file for a scene: its lamps with lumens and groups, cameras, what looks "
      "wrong. Or makes an empty room with luminaires, scene and side file.",
      {"sconce init kitchen.glb", "sconce init --room 8x6x2.8 --luminaire lamp.ldt --count 3x4 -o office.glb",
       "sconce bake {SCENE} --quality draft"});
  options.positional("SCENE", &given.scene, "scene file to write NAME.toml beside", false);
  options.option("--room", &given.size, "WIDTHxDEPTHxHEIGHT in metres: makes a room instead");
  options.option("--reflectance", &given.reflectance, "CEILING/WALLS/FLOOR of the room, percent");
  options.option("--luminaire", &given.luminaire,
                 "photometric file (.ies, .ldt, .xml) of the room's lamps; copied beside it");
  options.option("--count", &given.count, "COLUMNSxROWS of luminaires along width and depth");
  options.option("--mount", &given.mount,
                 "metres of the luminaires above the floor (default: at the ceiling)");
  options.option("-o,--output", &given.output,
                 "file to write: the side file, or the room (default room.glb)");
  options.flag("--force", &given.force, "write over files that are there");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (given.size.empty() == given.scene.empty())
    throw UsageError({}, given.size.empty() ? "nothing to begin with" : "a scene and a room are asked for",
                     "SCENE, or --room 8x6x2.8");
  if (!given.size.empty()) return init_room(given, options);

  Scene scene = import_scene(given.scene, make_progress(options));
  assign_groups(scene, Grouping::automatic);
  const fs::path side =
      given.output.empty() ? fs::path(given.scene).replace_extension(".toml") : fs::path(given.output);
  must_be_new(side, given.force);
  write_file(side, side_file_for(scene, fs::path(given.scene).filename().string()));
  if (!options.quiet) fmt::print("{}\n", side.string());
  options.next({given.scene});
  return kDone;
}

}  // namespace sconce::app
