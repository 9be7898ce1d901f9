// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/rgb.h"

namespace sconce {

/// A sparse matrix by rows. Weights are counts in units of `unit`, which is what shooting rays gives.
struct SparseRows {
  std::vector<uint64_t> first{0};  ///< per row and one more: range of columns and counts
  std::vector<uint32_t> columns;   ///< ascending within a row
  std::vector<uint16_t> counts;
  std::vector<Rgb> tints;  ///< per count: mean share of light that comes; empty = all of it
  float unit = 1;

  std::size_t size() const { return first.size() - 1; }

  /// out = row i times x, where x holds `width` numbers per column; sums in column order.
  /// @param x  columns x width; three channels in turn where there are tints
  void apply(std::size_t i, std::span<const float> x, std::span<float> out) const {
    const std::size_t width = out.size();
    for (float& value : out) value = 0;
    for (uint64_t k = first[i]; k < first[i + 1]; ++k) {
      const float weight = static_cast<float>(counts[k]);
      const float* column = x.data() + width * columns[k];
      if (!tints.empty()) {
        for (std::size_t c = 0; c < width; ++c) out[c] += weight * (&tints[k].r)[c % 3] * column[c];
        continue;
      }
      for (std::size_t c = 0; c < width; ++c) out[c] += weight * column[c];
    }
    for (float& value : out) value *= unit;
  }
};

}  // namespace sconce
