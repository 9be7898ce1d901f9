// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

/// The whole of `s` as a finite number, whatever the locale; nothing else may stand around it.
std::optional<double> parse_number(std::string_view s);

/// `*` and `?` globs.
bool glob_match(std::string_view pattern, std::string_view name);

/// "unknown group 'x'; did you mean 'y'?" material: the nearest of `names` within a third of its length, if
/// any.
std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> names);

/// "; did you mean 'y'?" for the end of a message, or nothing.
std::string did_you_mean(std::string_view wrong, std::span<const std::string> names);

std::vector<std::string> split(std::string_view s, char separator);
std::string join(std::span<const std::string> parts, std::string_view separator);
std::string trim(std::string_view s);
std::string lower(std::string_view s);

/// A name as a file name: letters, digits, `-` and `_` kept, others become `_` and a short hash keeps names
/// apart.
std::string safe_file_name(std::string_view name);

/// As a shell reads it back: as it is where that is safe, else in '...'.
std::string shell_word(std::string_view text);

}  // namespace sconce
