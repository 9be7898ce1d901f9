// SPDX-License-Identifier: Apache-2.0
// A TOML file as plain data with line numbers, and typed reading that says what is allowed.
// side_table.cpp is the only place in this module that names toml++.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce {

struct SideEntry;

struct SideNode {
  using Array = std::vector<SideNode>;
  using Table = std::vector<SideEntry>;
  std::variant<bool, double, std::string, Array, Table> value;
  int line = 0;

  const SideNode* find(std::string_view key) const;
};

struct SideEntry {
  std::string key;
  SideNode node;
};

/// @throws Error: file:line and what TOML expected
SideNode parse_side_file(const std::filesystem::path& path);

/// One table of the file with the keys that it may have.
class SideTable {
 public:
  /// @param title  "[[light]]", for errors
  /// @throws Error naming file:line, the key and what is allowed, for unknown keys; or when `node` is no
  /// table
  SideTable(std::string file, std::string title, const SideNode& node, std::vector<std::string> allowed);

  bool has(std::string_view key) const { return node_.find(key) != nullptr; }
  /// "kitchen.toml:12: intensity"; the table's own line without a key.
  std::string where(std::string_view key = {}) const;

  std::optional<double> number(std::string_view key) const;
  std::optional<double> positive(std::string_view key) const;      ///< > 0
  std::optional<double> not_negative(std::string_view key) const;  ///< >= 0
  std::optional<std::string> text(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<Vec3> vector(std::string_view key) const;
  std::optional<std::array<double, 2>> pair(std::string_view key) const;
  std::vector<std::string> list(
      std::string_view key) const;  ///< an array of strings, or one; empty where absent

  /// "#rrggbb" (sRGB) or [r, g, b] (linear), as it stands.
  std::optional<Rgb> color(std::string_view key) const;
  /// `color` or `kelvin`, brought to luminance 1.
  std::optional<Rgb> lamp_color() const;

  /// The row of that name in an explicit table. @param more  choices that are no rows
  template <class Rows>
  const auto& row(std::string_view key, const std::string& name, const Rows& rows,
                  const std::string& more = {}) const {
    std::string allowed;
    for (const auto& row : rows) {
      if (row.name == name) return row;
      allowed += (allowed.empty() ? "" : ", ") + std::string(row.name);
    }
    fail(key, "'" + name + "' is unknown", allowed + more);
  }

  [[noreturn]] void fail(std::string_view key, const std::string& what,
                         const std::string& allowed = {}) const;

 private:
  std::string file_, title_;
  const SideNode& node_;
};

}  // namespace sconce
