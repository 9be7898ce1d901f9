// SPDX-License-Identifier: Apache-2.0
#include "values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sconce::app {

namespace {

[[noreturn]] void expected(const char* what, std::string_view text) {
  throw UsageError({}, fmt::format("expected {}, got '{}'", what, text));
}

std::optional<double> finite(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

double parse_real(std::string_view text) {
  std::string_view digits = text;
  double scale = 1;
  if (digits.ends_with('%')) {
    digits.remove_suffix(1);
    scale = 100;
  }
  const std::optional<double> value = finite(digits);
  if (!value) expected("a number such as 0.02 or 2%", text);
  return *value / scale;
}

int parse_int(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  int value = 0;
  const auto [end, ec] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (ec != std::errc() || end != digits.data() + digits.size()) expected("a whole number", text);
  return value;
}

double parse_duration(std::string_view text) {
  std::string_view digits = text;
  double scale = 1;
  if (!digits.empty()) {
    const char unit = digits.back();
    if (unit == 's' || unit == 'm' || unit == 'h') {
      digits.remove_suffix(1);
      scale = unit == 'h' ? 3600 : unit == 'm' ? 60 : 1;
    }
  }
  const std::optional<double> value = finite(digits);
  if (!value || *value < 0) expected("a duration such as 90s, 10m or 1h", text);
  return *value * scale;
}

std::string show_real(double value) {
  return fmt::format("{}", value);
}

}  // namespace sconce::app
