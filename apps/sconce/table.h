// SPDX-License-Identifier: Apache-2.0
// Aligned text for people; machines get --json.
#pragma once

#include <string>
#include <vector>

namespace sconce::app {

class Table {
 public:
  enum class Align { left, right };
  struct Column {
    std::string title;
    Align align = Align::left;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// @pre as many cells as columns
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Two spaces between columns, every line indented by two.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// 1234567.8 -> "1,234,567.8" with `decimals` digits after the point.
std::string grouped(double value, int decimals = 0);

}  // namespace sconce::app
