// SPDX-License-Identifier: Apache-2.0
#include "mix/group_names.h"

#include <algorithm>
#include <array>
#include <regex>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

std::string last_capture(const std::smatch& match) {
  for (std::size_t i = match.size(); i-- > 1;)
    if (match[i].matched && match[i].length() > 0) return match[i];
  return match[0];
}

FoundGroups find_by(const GroupNaming& naming, const std::vector<std::string>& layers) {
  const std::regex expression("(?:(.*\\.)?)(?:" + naming.group + ")", std::regex::icase);
  FoundGroups found{naming.renderer, {}, {}};
  for (const std::string& layer : layers) {
    std::smatch match;
    if (!std::regex_match(layer, match, expression)) continue;
    if (found.groups.empty()) found.view = match[1];
    if (match[1] == found.view) found.groups.push_back({layer, last_capture(match)});
  }
  return found;
}

FoundGroups find_by_user(const std::string& text, const std::vector<std::string>& layers) {
  FoundGroups found;
  try {
    const std::regex expression(text);
    for (const std::string& layer : layers) {
      std::smatch match;
      if (std::regex_search(layer, match, expression)) found.groups.push_back({layer, last_capture(match)});
    }
  } catch (const std::regex_error& e) {
    throw UsageError("option '--groups-from'", "'" + text + "' is no regular expression: " + e.what());
  }
  return found;
}

}  // namespace

std::span<const GroupNaming> group_namings() {
  static const std::array<GroupNaming, 4> kRows{{
      {"Blender Cycles", "Combined_(.+)"},
      {"V-Ray", "(?:VRay_?)?Light[_ ]?Select[_. ]?(.+)"},
      {"LuxCore", "RADIANCE_GROUP[_#. ]?(.+)"},
      {"Arnold", "RGBA_(.+)"},
  }};
  return kRows;
}

FoundGroups find_groups(const std::vector<std::string>& layers, const std::string& expression) {
  if (!expression.empty()) return find_by_user(expression, layers);
  for (const GroupNaming& naming : group_namings())
    if (FoundGroups found = find_by(naming, layers); !found.groups.empty()) return found;
  return {};
}

std::optional<std::string> find_beauty(const std::vector<std::string>& layers, const FoundGroups& found) {
  static const std::array<std::string, 7> kNames{
      "combined", "beauty", "rgba", "rgb", "rgb_color", "rgb_imagepipeline", "rgb_imagepipeline_0"};
  const auto is_group = [&](const std::string& layer) {
    return std::any_of(found.groups.begin(), found.groups.end(),
                       [&](const NamedGroup& g) { return g.layer == layer; });
  };
  for (const std::string& view : {found.view, std::string()})
    for (const std::string& name : kNames)
      for (const std::string& layer : layers)
        if (lower(layer) == lower(view) + name && !is_group(layer)) return layer;
  if (std::find(layers.begin(), layers.end(), "") != layers.end()) return "";
  // Of a user's expression the view layer is not known.
  for (const std::string& layer : layers)
    if (lower(layer).ends_with(".combined") && !is_group(layer)) return layer;
  return {};
}

}  // namespace sconce
