// SPDX-License-Identifier: Apache-2.0
#include "transfer/coefficients.h"

#include <algorithm>

namespace sconce {

namespace {

std::size_t level_of(uint32_t coefficient) {
  return coefficient == 0 ? 0 : static_cast<std::size_t>(std::bit_width(coefficient) - 1) / 2;
}

}  // namespace

CoefficientChooser::CoefficientChooser(uint32_t n, Weighting weighting) : scores_(n, 0.0f) {
  float area = 1;
  for (float& weight : weights_) {
    weight = weighting == Weighting::none ? 1 : weighting == Weighting::area ? area * area : area;
    area /= 4;
  }
}

std::span<const uint32_t> CoefficientChooser::choose(std::span<const std::vector<SparseEntry>> rows,
                                                     std::size_t count) {
  touched_.clear();
  for (const std::vector<SparseEntry>& row : rows)
    for (const SparseEntry& e : row) {
      if (e.index == 0) continue;
      float& score = scores_[e.index];
      if (score == 0) touched_.push_back(e.index);
      // A square below the smallest float would be met again as new.
      score += std::max(e.value * e.value * weights_[level_of(e.index)], 1e-37f);
    }
  const auto better = [&](uint32_t a, uint32_t b) {
    return scores_[a] != scores_[b] ? scores_[a] > scores_[b] : a < b;
  };
  const std::size_t kept = std::min(count, touched_.size());
  if (kept < touched_.size())
    std::nth_element(touched_.begin(), touched_.begin() + static_cast<std::ptrdiff_t>(kept), touched_.end(),
                     better);
  for (const uint32_t index : touched_) scores_[index] = 0;
  std::sort(touched_.begin(), touched_.begin() + static_cast<std::ptrdiff_t>(kept));
  return {touched_.data(), kept};
}

}  // namespace sconce
