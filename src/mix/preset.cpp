// SPDX-License-Identifier: Apache-2.0
#include "mix/preset.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>

#include "core/error.h"
#include "core/files.h"

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
      } else if (key == "others" || key == "exposure" || key == "tone" || key == "camera") {
        const std::string value = value_of(path, key, *node);
        (key == "others"     ? preset.others
         : key == "exposure" ? preset.exposure
         : key == "tone"     ? preset.tone
                             : preset.camera) = value;
      } else {
        throw UsageError(place(path, node->source()), "unknown key '" + key + "'",
                         "mix, others, exposure, tone, camera");
      }
    }
  } catch (const toml::parse_error& e) {
    throw UsageError(place(path, e.source()), std::string(e.description()));
  }
  return preset;
}

}  // namespace sconce
