// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

/// The row of that name in an explicit table. @param kind  what rows are, for the message
/// @throws UsageError naming the choices
template <class Rows>
const auto& find_row(const Rows& rows, std::string_view name, std::string_view kind) {
  std::vector<std::string> names;
  for (const auto& row : rows) {
    if (row.name == name) return row;
    names.emplace_back(row.name);
  }
  throw UsageError({}, "unknown " + std::string(kind) + " '" + std::string(name) + "'", join(names, ", "));
}

}  // namespace sconce
