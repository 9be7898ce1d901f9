// SPDX-License-Identifier: Apache-2.0
// What `sconce info` prints: one text for people, one JSON value for machines.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "app.h"
#include "core/progress.h"
#include "core/rgb.h"
#include "core/vec.h"

namespace sconce::app {

struct InfoReport {
  std::string text;
  nlohmann::ordered_json json;
};

/// @param groups   how lights become groups, a name of scene/groups.h
/// @param options  list what `bake` would be told, too
InfoReport scene_info(const std::filesystem::path& path, const std::string& groups, bool options,
                      const Progress& progress);
/// @param groups_from  see find_groups()
InfoReport picture_info(const std::filesystem::path& path, const std::string& groups_from);
InfoReport package_info(const std::filesystem::path& path, bool options);

/// What `bake` would do with a scene's options: each value and where it is from. @throws UsageError
std::map<std::string, Options::Value> bake_options(const std::filesystem::path& scene);

/// Numbers as short as their float precision.
nlohmann::ordered_json json_of(const Rgb& c);
nlohmann::ordered_json json_of(const Vec3& v);
/// "#rrggbb" of a linear colour of any brightness, its largest channel at ff.
std::string hex_color(const Rgb& linear);
/// At most `limit` different names, repeated ones with their number, then how many more.
std::string some_names(const std::vector<std::string>& names, std::size_t limit = 4);

}  // namespace sconce::app
