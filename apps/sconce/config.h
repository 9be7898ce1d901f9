// SPDX-License-Identifier: Apache-2.0
// The [options] table of a TOML file: --config FILE, or the side file of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sconce::app {

struct ConfigEntry {
  std::string key;
  std::vector<std::string> values;  ///< as the command line would give them; a flag's is "true" or "false"
  bool is_boolean = false;
  uint32_t line = 0;
  std::string where;  ///< "kitchen.toml:12"
};

struct ConfigFile {
  bool has_table = false;
  std::vector<ConfigEntry> entries;  ///< in the order of the file
};

/// @throws UsageError with file and line: no valid TOML, or a value that is no text, number, boolean or list
/// of these
ConfigFile read_config(const std::filesystem::path& path);

}  // namespace sconce::app
