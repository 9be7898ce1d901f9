// SPDX-License-Identifier: Apache-2.0
#include "light/alias_table.h"

#include <algorithm>

namespace sconce {

AliasTable::AliasTable(std::span<const double> weights) : cells_(weights.size()), probabilities_(weights.size()) {
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
    cells_[s] = {static_cast<float>(scaled[s]), l};
    scaled[l] -= 1.0 - scaled[s];
    if (scaled[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // What is left differs from 1 by rounding only; a zero weight must never be picked.
  for (const uint32_t i : large) cells_[i] = {1.0f, i};
  for (const uint32_t i : small) cells_[i] = {1.0f, i};
}

std::size_t AliasTable::sample(float& u) const {
  const float scaled = u * static_cast<float>(cells_.size());
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), cells_.size() - 1);
  const float rest = std::min(scaled - static_cast<float>(i), 0x1.fffffep-1f);
  const Cell& cell = cells_[i];
  if (rest < cell.keep) {
    u = std::min(rest / cell.keep, 0x1.fffffep-1f);
    return i;
  }
  u = std::min((rest - cell.keep) / (1.0f - cell.keep), 0x1.fffffep-1f);
  return cell.alias;
}

}  // namespace sconce
