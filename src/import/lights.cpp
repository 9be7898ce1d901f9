// SPDX-License-Identifier: Apache-2.0
#include "import/lights.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "core/text.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

SideNode value_of(const std::vector<std::string>& parts) {
  SideNode::Array array;
  for (const std::string& part : parts) {
    const auto value = parse_number(part);
    array.push_back(value ? SideNode{*value, 0} : SideNode{part, 0});
  }
  return array.size() == 1 ? array[0] : SideNode{std::move(array), 0};
}

/// What [[luminaire]] calls what [[light]] says.
constexpr std::pair<std::string_view, std::string_view> kMeasuredKeys[] = {{"file", "file"},
                                                                           {"name", "name"},
                                                                           {"position", "at"},
                                                                           {"at", "at"},
                                                                           {"target", "aim"},
                                                                           {"aim", "aim"},
                                                                           {"direction", "direction"},
                                                                           {"roll", "roll"},
                                                                           {"lumens", "flux"},
                                                                           {"flux", "flux"},
                                                                           {"kelvin", "cct"},
                                                                           {"cct", "cct"},
                                                                           {"color", "color"},
                                                                           {"dim", "dim"},
                                                                           {"exact_below", "exact_below"}};

SideNode measured_table(const LightWords& words, const std::string& where) {
  SideNode::Table table;
  for (const auto& [key, value] : words.values) {
    const auto* row = std::find_if(std::begin(kMeasuredKeys), std::end(kMeasuredKeys),
                                   [&key = key](const auto& r) { return r.first == key; });
    if (row == std::end(kMeasuredKeys))
      throw UsageError(
          where, "unknown key '" + key + "'",
          "file, position, target, direction, roll, lumens, kelvin, color, dim, exact_below, name");
    // As it stands; beside the caller, who is no file.
    table.push_back({std::string(row->second),
                     key == "file" ? SideNode{std::filesystem::absolute(join(value, ",")).string(), 0}
                                   : value_of(value)});
  }
  return {std::move(table), 0};
}

SideNode light_table(const LightWords& words) {
  SideNode::Table table{{"type", SideNode{words.type, 0}}};
  for (const auto& [key, value] : words.values) table.push_back({key, value_of(value)});
  return {std::move(table), 0};
}

}  // namespace

LightWords split_light(std::string_view text, const std::string& where) {
  const std::vector<std::string> parts = split(text, ',');
  LightWords words{parts.front(), {}};
  for (std::size_t i = 1; i < parts.size();) {
    const std::size_t equals = parts[i].find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(where, "'" + parts[i] + "' is no KEY=VALUE",
                       "spot,position=X,Y,Z,target=X,Y,Z,lumens=N");
    words.values.push_back({parts[i].substr(0, equals), {parts[i].substr(equals + 1)}});
    while (++i < parts.size() && parts[i].find('=') == std::string::npos)
      words.values.back().second.push_back(parts[i]);
  }
  return words;
}

Light parse_light(const LightWords& words, const std::string& where) {
  Scene scene;
  apply_light({where, scene, {}}, light_table(words));
  return scene.lights.at(0);
}

MoreLights parse_lights(std::string_view text, const std::string& where, const Progress& progress) {
  const LightWords words = split_light(text, where);
  Scene scene;
  if (words.type == "luminaire")
    apply_luminaire({where, scene, progress}, measured_table(words, where));
  else
    apply_light({where, scene, progress}, light_table(words));
  return {std::move(scene.lights), std::move(scene.luminaires)};
}

MoreLights read_lights(const std::filesystem::path& path, const Progress& progress) {
  const SideNode root = parse_side_file(path);
  const SideTable file(path.string(), "the file of lights", root, {"light", "luminaire"});
  Scene scene;
  const SideContext context{path, scene, progress};
  // Each alone: [[light]] with the name of another one would change that.
  MoreLights all;
  for (const SideNode* node : side_tables(root, "light")) {
    scene.lights.clear();
    apply_light(context, *node);
    all.lights.push_back(scene.lights.at(0));
  }
  scene.lights.clear();
  for (const SideNode* node : side_tables(root, "luminaire")) apply_luminaire(context, *node);
  all.lights.insert(all.lights.end(), scene.lights.begin(), scene.lights.end());
  all.luminaires = std::move(scene.luminaires);
  if (all.lights.empty()) file.fail({}, "has no lights", "[[light]], [[luminaire]]");
  return all;
}

}  // namespace sconce
