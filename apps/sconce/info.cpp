// SPDX-License-Identifier: Apache-2.0
#include "info.h"

#include <fmt/format.h>

#include <cstdio>

#include "app.h"
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
  const std::size_t shown = names.size() > limit ? limit - 1 : names.size();
  std::string text = join(std::span(names).first(shown), ", ");
  if (shown < names.size()) text += fmt::format(", and {} more", names.size() - shown);
  return text;
}

int run_info(int argc, const char* const* argv) {
  std::string file, groups = "auto";
  bool list_options = false;
  Options options("info", "What is in a scene or a package.");
  options.positional("file", &file, "scene (.glb .gltf .obj) or package (NAME.sconce)");
  options.option("--groups", &groups, "how a scene's lights become groups: auto, named, per-light, one");
  options.flag("--options", &list_options, "list where each option of the bake came from");
  if (const auto code = options.parse(argc, argv)) return *code;

  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const bool is_package = std::filesystem::is_directory(file);
  const InfoReport report =
      is_package ? package_info(file, list_options) : scene_info(file, groups, list_options, progress);
  std::fputs((options.json ? report.json.dump(2) + "\n" : report.text).c_str(), stdout);
  return kDone;
}

}  // namespace sconce::app
