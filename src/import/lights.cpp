// SPDX-License-Identifier: Apache-2.0
#include "import/lights.h"

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

Light only_light(const std::filesystem::path& where, const SideNode& node, const Progress& progress) {
  Scene scene;
  apply_light({where, scene, progress}, node);
  return scene.lights.at(0);
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
  SideNode::Table table{{"type", SideNode{words.type, 0}}};
  for (const auto& [key, value] : words.values) table.push_back({key, value_of(value)});
  return only_light(where, SideNode{std::move(table), 0}, {});
}

Light parse_light(std::string_view text, const std::string& where) {
  return parse_light(split_light(text, where), where);
}

std::vector<Light> read_lights(const std::filesystem::path& path, const Progress& progress) {
  const SideNode root = parse_side_file(path);
  const SideTable file(path.string(), "the file of lights", root, {"light"});
  const SideNode* node = root.find("light");
  if (node == nullptr) file.fail({}, "has no lights", "[[light]]");
  std::vector<Light> lights;
  if (const auto* array = std::get_if<SideNode::Array>(&node->value)) {
    for (const SideNode& item : *array) lights.push_back(only_light(path, item, progress));
  } else {
    lights.push_back(only_light(path, *node, progress));
  }
  return lights;
}

}  // namespace sconce
