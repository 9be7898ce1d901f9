// SPDX-License-Identifier: Apache-2.0
// A window driven by a file: one word with its arguments a line, `#` begins a comment, "quotes" hold blanks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

struct Action {
  std::string word;
  std::vector<std::string> arguments;
  std::string where;  ///< "FILE:LINE"
};

struct ActionRow {
  std::string_view word, usage, doc;
  std::size_t fewest = 0, most = 0;  ///< arguments
};
/// All words, in the order in which help shows them.
std::span<const ActionRow> action_rows();

/// @throws UsageError naming file and line, and what is allowed
std::vector<Action> parse_script(std::string_view text, const std::string& file);

}  // namespace sconce
