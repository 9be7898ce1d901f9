// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewer.h"

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "lamp_kinds.h"
#include "live_bake.h"
#include "picture_options.h"

namespace sconce::app {

int run_view(int argc, const char* const* argv) {
  std::string input, script, size, groups_from;
  bool forget = false, no_reflections = false;
  Options options("view",
                  "A window on a package: its light groups on faders, the picture following; on a scene, "
                  "which is baked while you look; or on another renderer's picture with light groups.",
                  {"sconce view kitchen.sconce", "sconce view kitchen.glb",
                   "sconce render {PACKAGE} --preset NAME.toml"});
  options.positional("FILE", &input,
                     "NAME.sconce, a scene (glTF, OBJ) or an OpenEXR picture; none = an empty window", false);
  options.option("--groups-from", &groups_from,
                 "regular expression of a picture's layers that are groups, as for `sconce mix`");
  options.option("--script", &script,
                 "does what this file says, line by line, then closes; see docs/window.md");
  options.option("--size", &size, "WIDTHxHEIGHT of the window (default: as the last time)");
  options.flag(
      "--no-reflections", &no_reflections,
      "no reflections are followed, even while nothing moves: metals are as if matt");
  options.flag("--forget", &forget, "neither reads nor keeps sizes and recent files");
  if (const auto code = options.parse(argc, argv)) return *code;

  viewer::ViewRequest request;
  request.file = input;
  request.groups_from = groups_from;
  request.reflections = !no_reflections;
  request.forget = forget || !script.empty();
  if (!script.empty()) request.script = parse_script(read_file(script), script);
  if (!size.empty()) {
    const PictureSize wanted = parse_size(size);
    request.width = wanted.width;
    request.height = wanted.height > 0 ? wanted.height : wanted.width * 9 / 16;
  }
  if (!input.empty() && !std::filesystem::exists(input)) throw Error(input, "no such file");
  if (!groups_from.empty() && lower(std::filesystem::path(input).extension().string()) != ".exr")
    throw UsageError("option '--groups-from'", input + " is no picture", "an OpenEXR picture");
  request.bake = live_bake;
  for (const LampKind& kind : lamp_kinds())
    if (!kind.words.empty()) request.kinds.emplace_back(kind.name, kind.words);
  request.kind_of_file = kind_of_file;
  request.become = [](const Lamp& lamp, const LampPlace& at, const std::string& words) {
    return become(lamp, at, words, words);
  };
  const ThreadLimit threads(options.threads);
  viewer::show_window(request);
  return kDone;
}

}  // namespace sconce::app
