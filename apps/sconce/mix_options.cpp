// SPDX-License-Identifier: Apache-2.0
#include "mix_options.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"

namespace sconce::app {

void MixOptions::declare(Options& options) {
  options.positionals(
      "GROUP=SETTING", &settings,
      "off, on, 0.5, 50%, +1.5ev, 800lm, 2700K, color:#rrggbb, #rrggbb, joined by commas; GROUP may be "
      "a glob, or 'all'");
  options.option("--preset", &preset_file, "TOML file with settings, exposure, tone and camera");
  options.option("--others", &others, "setting of every group that is not named");
  options.flag("--raw", &raw, "the layers as they were before the denoiser");
}

Package MixOptions::open(const std::string& path) const {
  Package package = Package::open(path);
  return raw ? package.undenoised() : package;
}

Preset MixOptions::preset() const {
  return preset_file.empty() ? Preset{} : read_preset(preset_file);
}

MixSpec MixOptions::make(const Preset& preset, std::span<const GroupInfo> groups,
                         const Progress& progress) const {
  if (!preset.lamps.empty() && !moves_lamps)
    progress.warn("the preset's lamps stay where they were baked: sconce relight --preset moves them");
  std::vector<std::string> all = preset.assignments;
  all.insert(all.end(), settings.begin(), settings.end());
  return make_mix(groups, all, others.empty() ? preset.others : others,
                  [&](const std::string& line) { progress.warn(line); });
}

std::string weights_json(std::span<const GroupInfo> groups, const MixSpec& mix) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Rgb& w = mix.weights[g];
    list.push_back({{"name", groups[g].name}, {"weight", {w.r, w.g, w.b}}});
  }
  return list.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void check_output(const std::string& path, const std::vector<std::string>& extensions) {
  if (path == "-") return;
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw UsageError("option '--output'", "'" + path + "' has no known extension",
                     join(extensions, ", ") + ", -");
  // Told before the work, not after it.
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (std::filesystem::is_directory(path)) throw Error(path, "is a folder");
  if (!std::filesystem::is_directory(folder)) throw Error(path, "cannot be written: no such folder");
  if (::access(folder.c_str(), W_OK) != 0)
    throw Error(path, std::string("cannot be written: ") + std::strerror(errno));
}

void write_stdout(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
    throw Error("standard output", std::strerror(errno));
}

}  // namespace sconce::app
