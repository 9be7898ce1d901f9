// SPDX-License-Identifier: Apache-2.0
#include "session/script.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr std::size_t kAny = 1000;
constexpr ActionRow kRows[] = {
    {"set", "GROUP=SETTING...", "faders, as `sconce render` takes them", 1, kAny},
    {"solo", "GROUP", "shows that group alone, or ends it", 1, 1},
    {"mute", "GROUP", "hides that group, or ends it", 1, 1},
    {"master", "GAIN", "of all groups: 0.5, +1ev", 1, 1},
    {"undo", "", "takes the last step back", 0, 0},
    {"redo", "", "takes it again", 0, 0},
    {"preset", "FILE [SECONDS]", "cross-fades to a preset", 1, 2},
    {"save", "FILE", "writes the mix as a preset", 1, 1},
    {"keep", "a|b", "keeps the mix aside", 1, 1},
    {"recall", "a|b [SECONDS]", "cross-fades to what was kept", 1, 2},
    {"ev100", "EV", "absolute exposure; higher is darker", 1, 1},
    {"auto", "[STOPS]", "exposure follows the mix", 0, 1},
    {"hold", "", "meters once and holds the exposure", 0, 0},
    {"tone", "CURVE", "agx, drago, drago2006, reinhard, aces, neutral, linear", 1, 1},
    {"camera", "NAME", "looks through a camera of the scene", 1, 1},
    {"eye", "X,Y,Z X,Y,Z", "looks from the first point to the second", 2, 2},
    {"look", "KIND", "picture, lux, cd/m2, lightmap, noise, albedo, normals, charts, reference", 1, 1},
    {"scale", "LOW HIGH [decades]", "of false colours", 2, 3},
    {"lines", "on|off", "iso-lines over false colours", 1, 1},
    {"plane", "NAME|HEIGHT [SPACING]",
     "shows lux on a baked plane, or measures it on a horizontal one, metres above the floor", 1, 2},
    {"ball", "X,Y,Z [RADIUS]", "puts a ball there, lit by the package's probes, metres", 1, 2},
    {"figures", "FILE.csv", "writes minimum, average, maximum and uniformity of all planes, as mixed", 1, 1},
    {"wish", "X,Y,Z[,NX,NY,NZ] LUX", "a goal at a point, metres; faces up unless told otherwise", 2, 2},
    {"lamp", "LAMP X,Y,Z", "a lamp leaves its layer and shines from there", 2, 2},
    {"aim", "LAMP X,Y,Z", "a lamp is turned to a place", 2, 2},
    {"grab", "LAMP", "shows the handles of a lamp", 1, 1},
    {"tug", "x|y|z|floor DX,DY", "the mouse drags that handle of the lamp or object by so many pixels", 2, 2},
    {"kind", "LAMP own|WORDS", "a lamp becomes another one: point, spot,outer=40, shader,file=barn.glsl", 2,
     2},
    {"home", "", "the lamp goes back to its layer, the object to its place", 0, 0},
    {"object", "NAME X,Y,Z[,DEGREES]", "the middle of an object goes there, metres; it is turned, from above",
     2, 2},
    {"pick", "NAME", "shows the handles of an object; tug and home are for it, then", 1, 1},
    {"objects", "FILE",
     "writes where objects went, as `sconce relight --object` takes it, and how far bounces are", 1, 1},
    {"moves", "FILE", "writes where lamps went, as `sconce relight --move` takes it", 1, 1},
    {"like", "FILE", "a goal: look like this picture", 1, 1},
    {"seek", "", "moves the faders to the goals", 0, 0},
    {"drop", "FILE", "opens a package, scene or preset, as if it was dropped", 1, 1},
    {"key", "KEYS", "presses keys: ctrl+z, f1, space, w", 1, 1},
    {"type", "TEXT", "into the field that was clicked", 1, 1},
    {"move", "X,Y", "the pointer, pixels from the top left", 1, 1},
    {"drag", "X,Y X,Y", "left button from the first place to the second", 2, 2},
    {"click", "X,Y", "left button", 1, 1},
    {"pull", "GROUP PIXELS", "the mouse drags that group's fader to the right", 2, 2},
    {"frames", "N", "draws that many", 1, 1},
    {"wait", "SECONDS", "draws as long as that", 1, 1},
    {"settle", "", "draws until nothing is left to do: samples, fades, measurements, a bake", 0, 0},
    {"screenshot", "FILE.png", "the whole window", 1, 1},
    {"picture", "FILE.png|.exr", "the picture alone, without panels; OpenEXR is linear, before exposure", 1,
     1},
    {"turntable", "FILE N", "the camera turns once: N pictures NAME.%04d.png or .exr, or NAME.mp4", 2, 2},
    {"times", "FILE.csv",
     "writes how long the frames took in which faders moved, since the last `times`: milliseconds of the "
     "window's own work, of OpenGL",
     1, 1},
    {"package", "NAME.sconce", "saves what was baked", 1, 1},
    {"scene", "NAME.glb", "writes the scene as it is mixed, as `sconce export --scene`", 1, 1},
    {"quit", "", "ends", 0, 0},
};

std::vector<std::string> words_of(std::string_view line, const std::string& where) {
  std::vector<std::string> words;
  bool quoted = false, open = false;
  for (const char c : line) {
    if (!quoted && c == '#') break;
    if (c == '"') {
      quoted = !quoted;
      if (!open) words.emplace_back(), open = true;
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
      open = false;
    } else {
      if (!open) words.emplace_back(), open = true;
      words.back() += c;
    }
  }
  if (quoted) throw UsageError(where, "a quote is not closed");
  return words;
}

}  // namespace

std::span<const ActionRow> action_rows() {
  return kRows;
}

std::vector<Action> parse_script(std::string_view text, const std::string& file) {
  std::vector<Action> actions;
  std::vector<std::string> names;
  for (const ActionRow& row : kRows) names.emplace_back(row.word);
  std::size_t number = 0;
  for (const std::string& line : split(text, '\n')) {
    const std::string where = fmt::format("{}:{}", file, ++number);
    std::vector<std::string> words = words_of(line, where);
    if (words.empty()) continue;
    const std::string word = words.front();
    words.erase(words.begin());
    const ActionRow* found = nullptr;
    for (const ActionRow& row : kRows)
      if (row.word == word) found = &row;
    if (found == nullptr)
      throw UsageError(where, "unknown word '" + word + "'" + did_you_mean(word, names), join(names, ", "));
    if (words.size() < found->fewest || words.size() > found->most)
      throw UsageError(where, fmt::format("{} has {} arguments", word, words.size()),
                       fmt::format("{} {}", word, found->usage));
    actions.push_back({word, words, where});
  }
  return actions;
}

}  // namespace sconce
