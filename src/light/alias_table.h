// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace sconce {

/// Picks an index in proportion to weights in O(1) (Walker 1977, Vose 1991).
class AliasTable {
 public:
  AliasTable() = default;
  /// @param weights  not negative; all zero counts as all equal
  explicit AliasTable(std::span<const double> weights);

  std::size_t size() const { return cells_.size(); }
  double probability(std::size_t i) const { return probabilities_[i]; }

  /// @param u  in [0,1); rescaled so that it is uniform again given the index
  std::size_t sample(float& u) const {
    const float scaled = u * static_cast<float>(cells_.size());
    const std::size_t i = std::min(static_cast<std::size_t>(scaled), cells_.size() - 1);
    const float rest = std::min(scaled - static_cast<float>(i), 0x1.fffffep-1f);
    const Cell& cell = cells_[i];
    if (rest < cell.keep) {
      u = std::min(rest * cell.per_keep, 0x1.fffffep-1f);
      return i;
    }
    u = std::min((rest - cell.keep) * cell.per_rest, 0x1.fffffep-1f);
    return cell.alias;
  }

 private:
  struct Cell {
    float keep;
    uint32_t alias;
    float per_keep, per_rest;  ///< 1 / keep and 1 / (1 - keep)
  };
  std::vector<Cell> cells_;
  std::vector<float> probabilities_;
};

}  // namespace sconce
