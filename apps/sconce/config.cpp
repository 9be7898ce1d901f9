// SPDX-License-Identifier: Apache-2.0
#include "config.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "core/toml.h"
#include "values.h"

namespace sconce::app {

namespace {

std::optional<std::string> scalar_text(const toml::node& node) {
  if (const auto* v = node.as_string()) return v->get();
  if (const auto* v = node.as_integer()) return std::to_string(v->get());
  if (const auto* v = node.as_floating_point()) return show_real(v->get());
  if (const auto* v = node.as_boolean()) return v->get() ? "true" : "false";
  return std::nullopt;
}

}  // namespace

ConfigFile read_config(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_file(path);
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }
  const auto where = [&](const toml::source_region& region) {
    return fmt::format("{}:{}", path.string(), region.begin.line);
  };
  ConfigFile config;
  toml::table root;
  try {
    root = toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw UsageError(where(error.source()), std::string(error.description()));
  }
  const toml::node* options = root.get("options");
  if (options == nullptr) return config;
  const toml::table* table = options->as_table();
  if (table == nullptr) throw UsageError(where(options->source()), "options must be a table", "[options]");
  config.has_table = true;
  for (const auto& [key, node] : *table) {
    ConfigEntry entry;
    entry.key = std::string(key.str());
    entry.line = key.source().begin.line;
    entry.where = where(key.source());
    entry.is_boolean = node.is_boolean();
    const auto add = [&](const toml::node& value) {
      const std::optional<std::string> scalar = scalar_text(value);
      if (!scalar) {
        throw UsageError(entry.where, fmt::format("option '{}' has an unsuitable value", entry.key),
                         "a text, a number, true, false, or a list of texts");
      }
      entry.values.push_back(*scalar);
    };
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& element : *list) add(element);
    } else {
      add(node);
    }
    config.entries.push_back(std::move(entry));
  }
  // toml++ keeps keys by name; users read them by line.
  std::ranges::stable_sort(config.entries, {}, &ConfigEntry::line);
  return config;
}

}  // namespace sconce::app
