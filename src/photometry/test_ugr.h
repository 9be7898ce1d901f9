// SPDX-License-Identifier: Apache-2.0
// For tests only: UGR tables against those that DIALux, Relux and CIE 190 give for the same files.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "photometry/formats.h"
#include "photometry/lines.h"
#include "photometry/ugr.h"

namespace sconce {

inline constexpr const char* kUgrSamples[] = {"01", "02", "05", "06", "11"};

struct UgrComparison {
  std::size_t references = 0, cells = 0;
  std::size_t near = 0;  ///< cells within 0.1 of the nearest reference, both rounded to 0.1
  double outside = 0;    ///< furthest that a cell lies outside of the references' span
};

/// @param folder  eulumdat-ugr of the shared data
inline UgrComparison compare_ugr(const std::filesystem::path& folder, const std::string& sample) {
  // 19 x 10 values; nothing where a reference says "<10.0".
  std::vector<std::vector<std::optional<double>>> references;
  for (const char* who : {"Dialux", "Relux", "cie190"}) {
    const auto file = folder / "reference" / ("ugr_table_" + sample + "_" + who + ".csv");
    if (!std::filesystem::exists(file)) continue;
    auto& values = references.emplace_back();
    for (const std::string& line : lines_of(read_file(file)))
      if (!trim(line).empty())
        for (const std::string& cell : split(line, ',')) values.push_back(parse_number(trim(cell)));
    if (values.size() != 190) throw Error(file.string(), "holds no 190 values");
  }
  const UgrTable table = ugr_table(read_photometry(folder / "input" / ("sample_" + sample + ".ldt")));
  UgrComparison out;
  out.references = references.size();
  for (std::size_t i = 0; i < 190; ++i) {
    const double ours = std::round(table.values[i / 10][i % 10] * 10) / 10;
    double distance = 1e9, low = 1e9, high = -1e9;
    for (const auto& reference : references) {
      const double v = reference[i].value_or(std::min(ours, 9.9));
      distance = std::min(distance, std::abs(v - ours));
      low = std::min(low, v), high = std::max(high, v);
    }
    ++out.cells;
    out.near += distance < 0.101;
    out.outside = std::max({out.outside, low - ours, ours - high});
  }
  return out;
}

}  // namespace sconce
