// SPDX-License-Identifier: Apache-2.0
#include "info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"

namespace sconce::app {

std::string hex_color(const Rgb& linear) {
  const float top = linear.max();
  const auto code = [&](float v) {
    return top > 0 ? static_cast<int>(255.0f * linear_to_srgb(std::clamp(v / top, 0.0f, 1.0f)) + 0.5f) : 0;
  };
  return fmt::format("#{:02x}{:02x}{:02x}", code(linear.r), code(linear.g), code(linear.b));
}

std::string some_names(const std::vector<std::string>& names, std::size_t limit) {
  std::vector<std::pair<std::string, int>> counted;
  for (const std::string& name : names) {
    const auto same =
        std::find_if(counted.begin(), counted.end(), [&](const auto& c) { return c.first == name; });
    if (same != counted.end()) {
      ++same->second;
    } else {
      counted.emplace_back(name, 1);
    }
  }
  const std::size_t shown = counted.size() > limit ? limit - 1 : counted.size();
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    text += (text.empty() ? "" : ", ") + counted[i].first;
    if (counted[i].second > 1) text += fmt::format(" ({} times)", counted[i].second);
  }
  if (shown < counted.size()) text += fmt::format(", and {} more", counted.size() - shown);
  return text;
}

namespace {

double shortest(float value) {
  return parse_number(fmt::format("{}", value)).value_or(static_cast<double>(value));
}

}  // namespace

nlohmann::ordered_json json_of(const Rgb& c) {
  return {shortest(c.r), shortest(c.g), shortest(c.b)};
}
nlohmann::ordered_json json_of(const Vec3& v) {
  return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

int run_info(int argc, const char* const* argv) {
  std::string file, groups = "auto", groups_from;
  bool list_options = false;
  Options options("info", "What is in a scene, a package, or a picture with light groups.",
                  {"sconce info kitchen.glb --options", "sconce info kitchen.sconce --json",
                   "sconce bake {SCENE} --quality draft"});
  options.positional(
      "file", &file,
      "scene (.glb .gltf .obj .fbx .dae .3ds .ply .stl .blend), package (NAME.sconce) or picture (.exr)");
  options.option("--groups", &groups, "how a scene's lights become groups: auto, named, per-light, one");
  options.option(
      "--groups-from", &groups_from,
      "regular expression of the layers of a picture that are groups; what it captures is the name");
  options.flag("--options", &list_options, "list each option of the bake, its value and where it came from");
  if (const auto code = options.parse(argc, argv)) return *code;

  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const bool is_package = std::filesystem::is_directory(file);
  const bool is_picture = !is_package && lower(std::filesystem::path(file).extension().string()) == ".exr";
  if (!is_picture && !groups_from.empty())
    throw UsageError("option '--groups-from'", file + " is no picture", "an OpenEXR picture");
  const InfoReport report = is_picture   ? picture_info(file, groups_from)
                            : is_package ? package_info(file, list_options)
                                         : scene_info(file, groups, list_options, progress);
  std::fputs((options.json ? report.json.dump(2) + "\n" : report.text).c_str(), stdout);
  if (report.json.value("triangles", 0) > 0) options.next({file});
  return kDone;
}

}  // namespace sconce::app
