// SPDX-License-Identifier: Apache-2.0
#include "mix/preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/toml.h"

namespace sconce {

namespace {

std::string place(const std::filesystem::path& path, const toml::source_region& source) {
  return path.string() + ":" + std::to_string(source.begin.line);
}

/// A text as it stands, a number as text.
std::string value_of(const std::filesystem::path& path, std::string_view key, const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
  throw UsageError(place(path, node.source()), "'" + std::string(key) + "' is neither text nor number");
}

/// Entries in the file's order; toml++ sorts them by name.
std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(key.str(), &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto &p = a.second->source().begin, &q = b.second->source().begin;
    return std::pair(p.line, p.column) < std::pair(q.line, q.column);
  });
  return entries;
}

struct Field {
  std::string_view key;
  std::string Preset::*value;
};
constexpr Field kFields[] = {{"others", &Preset::others},
                             {"exposure", &Preset::exposure},
                             {"ev100", &Preset::ev100},
                             {"tone", &Preset::tone},
                             {"camera", &Preset::camera}};

std::optional<Vec3> vector_of(const std::filesystem::path& path, const std::string& lamp,
                              std::string_view key, const toml::node& node) {
  const auto wrong = [&] {
    return UsageError(place(path, node.source()),
                      "lamp '" + lamp + "': '" + std::string(key) + "' is no place", "[x, y, z] in metres");
  };
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) throw wrong();
  Vec3 out(0);
  for (int i = 0; i < 3; ++i) {
    const auto number = (*array)[static_cast<std::size_t>(i)].value<double>();
    if (!number || !std::isfinite(*number)) throw wrong();
    out[i] = static_cast<float>(*number);
  }
  return out;
}

PresetLamp lamp_of(const std::filesystem::path& path, const std::string& name, const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr)
    throw UsageError(place(path, node.source()), "lamp '" + name + "' is no table",
                     "[lamp.\"" + name + "\"]");
  PresetLamp lamp{name};
  for (const auto& [key, value] : in_order(*table)) {
    if (key == "at")
      lamp.at = vector_of(path, name, key, *value);
    else if (key == "target")
      lamp.target = vector_of(path, name, key, *value);
    else if (key == "kind")
      lamp.kind = value_of(path, key, *value);
    else
      throw UsageError(place(path, value->source()), "lamp '" + name + "': unknown key '" + key + "'",
                       "at, target, kind");
  }
  return lamp;
}

std::string* field_of(Preset& preset, std::string_view key) {
  for (const Field& field : kFields)
    if (field.key == key) return &(preset.*field.value);
  return nullptr;
}

}  // namespace

Preset read_preset(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  Preset preset;
  try {
    const toml::table root = toml::parse(text, path.string());
    for (const auto& [key, node] : in_order(root)) {
      if (key == "mix") {
        const toml::table* mix = node->as_table();
        if (mix == nullptr) throw UsageError(place(path, node->source()), "'mix' is no table");
        for (const auto& [group, setting] : in_order(*mix)) {
          const std::string value = value_of(path, group, *setting);
          if (group == "others") {
            preset.others = value;
          } else {
            preset.assignments.push_back(group + "=" + value);
          }
        }
      } else if (key == "lamp") {
        const toml::table* lamps = node->as_table();
        if (lamps == nullptr)
          throw UsageError(place(path, node->source()), "'lamp' is no table", "[lamp.NAME]");
        for (const auto& [name, lamp] : in_order(*lamps)) preset.lamps.push_back(lamp_of(path, name, *lamp));
      } else if (std::string* field = field_of(preset, key)) {
        *field = value_of(path, key, *node);
      } else {
        throw UsageError(place(path, node->source()), "unknown key '" + key + "'",
                         "mix, lamp, others, exposure, ev100, tone, camera");
      }
    }
  } catch (const toml::parse_error& e) {
    throw UsageError(place(path, e.source()), std::string(e.description()));
  }
  if (!preset.exposure.empty() && !preset.ev100.empty())
    throw UsageError(path.string(), "exposure and ev100 exclude each other");
  return preset;
}

std::string print_preset(const Preset& preset) {
  std::ostringstream text;
  const auto quoted = [](const std::string& value) { return toml::value<std::string>(value); };
  for (const Field& field : kFields)
    if (!(preset.*field.value).empty()) text << field.key << " = " << quoted(preset.*field.value) << '\n';
  text << "[mix]\n";
  for (const std::string& assignment : preset.assignments) {
    const std::size_t equals = assignment.rfind('=');
    text << quoted(assignment.substr(0, equals)) << " = " << quoted(assignment.substr(equals + 1)) << '\n';
  }
  for (const PresetLamp& lamp : preset.lamps) {
    const auto vector = [&](const char* key, const std::optional<Vec3>& v) {
      if (v) text << key << fmt::format(" = [{:.4f}, {:.4f}, {:.4f}]\n", v->x, v->y, v->z);
    };
    text << "\n[lamp." << quoted(lamp.name) << "]\n";
    vector("at", lamp.at), vector("target", lamp.target);
    if (!lamp.kind.empty()) text << "kind = " << quoted(lamp.kind) << '\n';
  }
  return std::move(text).str();
}

}  // namespace sconce
