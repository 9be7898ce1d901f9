// SPDX-License-Identifier: Apache-2.0
#include "photometry/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr std::string_view kSeparators = " \t,;\f\v\x1a";

std::string counted(const std::string& what, std::size_t index, std::size_t count) {
  return what + " " + std::to_string(index + 1) + " of " + std::to_string(count);
}

}  // namespace

std::vector<std::string> lines_of(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    out.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
  }
  return out;
}

std::ptrdiff_t line_of(std::string_view text, std::ptrdiff_t offset) {
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
  return 1 + std::count(text.begin(), end, '\n');
}

bool Numbers::find() {
  for (; line_ < lines_.size(); ++line_, column_ = 0) {
    const std::string_view line = std::string_view(lines_[line_]).substr(0, lines_[line_].find("//"));
    if (column_ >= line.size()) continue;
    column_ = line.find_first_not_of(kSeparators, column_);
    if (column_ != std::string_view::npos) return true;
  }
  return false;
}

bool Numbers::more() {
  return find();
}

/// @param name  makes what an error calls the number
template <class Name>
double Numbers::read(const Name& name) {
  if (!find()) {
    line_ = lines_.empty() ? 0 : lines_.size() - 1;
    fail("ends before " + name());
  }
  const std::string_view rest = std::string_view(lines_[line_]).substr(column_);
  std::string_view token = rest.substr(0, rest.find_first_of(kSeparators));
  token = token.substr(0, token.find("//"));
  column_ += token.size();
  const auto value = parse_number(token);
  if (!value || !std::isfinite(*value))
    fail("'" + std::string(token) + "' stands where " + name() + " should", "a number");
  return *value;
}

double Numbers::next(const std::string& what) {
  return read([&] { return what; });
}

int Numbers::integer(const std::string& what, int least, int most) {
  const double v = next(what);
  if (!(v >= least && v <= most) || v != std::floor(v))
    fail(fmt::format("{} is {:g}", what, v),
         "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(v);
}

std::vector<double> Numbers::list(std::size_t count, const std::string& what) {
  std::vector<double> out;
  while (out.size() < count) out.push_back(read([&] { return counted(what, out.size(), count); }));
  return out;
}

std::vector<double> Numbers::ascending(std::size_t count, const std::string& what) {
  std::vector<double> out;
  while (out.size() < count) {
    const double v = read([&] { return counted(what, out.size(), count); });
    if (!out.empty() && !(v > out.back()))
      fail(counted(what, out.size(), count) + " is not above the one before");
    out.push_back(v);
  }
  return out;
}

std::string Numbers::place() const {
  return where_ + ":" + std::to_string(line());
}

void Numbers::fail(const std::string& what, const std::string& allowed) const {
  throw Error(place(), what, allowed);
}

}  // namespace sconce
