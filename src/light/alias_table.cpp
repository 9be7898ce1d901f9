// SPDX-License-Identifier: Apache-2.0
#include "light/alias_table.h"

namespace sconce {

AliasTable::AliasTable(std::span<const double> weights)
    : cells_(weights.size()), probabilities_(weights.size()) {
  const std::size_t n = weights.size();
  double sum = 0;
  for (const double w : weights) sum += w;
  std::vector<double> scaled(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double p = sum > 0 ? weights[i] / sum : 1.0 / static_cast<double>(n);
    probabilities_[i] = static_cast<float>(p);
    scaled[i] = p * static_cast<double>(n);
  }
  std::vector<uint32_t> small, large;
  for (uint32_t i = 0; i < n; ++i) (scaled[i] < 1.0 ? small : large).push_back(i);
  while (!small.empty() && !large.empty()) {
    const uint32_t s = small.back(), l = large.back();
    small.pop_back();
    cells_[s] = {static_cast<float>(scaled[s]), l, 0, 0};
    scaled[l] -= 1.0 - scaled[s];
    if (scaled[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // What is left differs from 1 by rounding only; a zero weight must never be picked.
  for (const uint32_t i : large) cells_[i] = {1.0f, i, 0, 0};
  for (const uint32_t i : small) cells_[i] = {1.0f, i, 0, 0};
  for (Cell& cell : cells_) cell.per_keep = 1 / cell.keep, cell.per_rest = 1 / (1 - cell.keep);
}

}  // namespace sconce
