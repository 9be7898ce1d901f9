// SPDX-License-Identifier: Apache-2.0
#include "transfer/coefficients.h"

#include <algorithm>

namespace sconce {

std::vector<float> squared_weights(uint32_t n, Weighting weighting) {
  std::vector<float> squares(n, 1.0f);
  for (uint32_t i = 0; i < n; ++i) {
    const float area = static_cast<float>(haar_support(i, n)) / static_cast<float>(n);
    if (weighting != Weighting::none) squares[i] = weighting == Weighting::area ? area * area : area;
  }
  return squares;
}

void CoefficientChooser::add(uint32_t coefficient, float square) {
  if (coefficient == 0) return;
  float& score = scores_[coefficient];
  if (score == 0) touched_.push_back(coefficient);
  // A square below the smallest float would be met again as new.
  score += std::max(square * squares_[coefficient], 1e-37f);
}

std::span<const uint32_t> CoefficientChooser::choose(std::size_t count) {
  const auto better = [&](uint32_t a, uint32_t b) {
    return scores_[a] != scores_[b] ? scores_[a] > scores_[b] : a < b;
  };
  const std::size_t kept = std::min(count, touched_.size());
  const auto end = touched_.begin() + static_cast<std::ptrdiff_t>(kept);
  if (kept < touched_.size()) std::nth_element(touched_.begin(), end, touched_.end(), better);
  for (const uint32_t index : touched_) scores_[index] = 0;
  touched_.resize(kept);
  std::sort(touched_.begin(), touched_.end());
  chosen_.swap(touched_);
  touched_.clear();
  return chosen_;
}

}  // namespace sconce
