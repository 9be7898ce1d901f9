// SPDX-License-Identifier: Apache-2.0
// Text in lines, and numbers one after the other whatever their lines: how photometric files are laid out.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

/// Lines without their ends (LF, CR LF or CR) and without a byte order mark.
std::vector<std::string> lines_of(std::string_view text);

/// Line of a byte of a text, from 1 on.
std::ptrdiff_t line_of(std::string_view text, std::ptrdiff_t offset);

/// Numbers of all lines from `line` on, separated by blanks or commas; `//` starts a comment.
class Numbers {
 public:
  /// @param line  index of the first line
  Numbers(const std::vector<std::string>& lines, std::size_t line, std::string where)
      : lines_(lines), line_(line), where_(std::move(where)) {}

  /// @param what  of the number, for errors: "candela value 3 of 20"
  /// @throws Error naming file:line when there is none, or no number
  double next(const std::string& what);
  /// A whole number within [least, most].
  int integer(const std::string& what, int least, int most);
  std::vector<double> list(std::size_t count, const std::string& what);
  /// As list, and each more than the one before.
  std::vector<double> ascending(std::size_t count, const std::string& what);

  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const;
  /// "lamp.ies:12", of the number read last.
  std::string place() const;
  int line() const { return static_cast<int>(line_) + 1; }
  /// Is anything but blanks left?
  bool more();

 private:
  bool find();
  template <class Name>
  double read(const Name& name);

  const std::vector<std::string>& lines_;
  std::size_t line_, column_ = 0;
  std::string where_;
};

}  // namespace sconce
