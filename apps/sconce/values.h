// SPDX-License-Identifier: Apache-2.0
// Text of an option to its value. Messages say what was expected; the caller adds which option it was.
#pragma once

#include <string>
#include <string_view>

namespace sconce::app {

/// `0.02`, `2%` = 0.02. @throws UsageError
double parse_real(std::string_view text);
/// A whole number. @throws UsageError
int parse_int(std::string_view text);
/// Seconds: `90`, `90s`, `10m`, `1.5h`. @throws UsageError
double parse_duration(std::string_view text);

/// The shortest text that reads back as the same number.
std::string show_real(double value);

}  // namespace sconce::app
