// SPDX-License-Identifier: Apache-2.0
#include "solve/pick.h"

namespace sconce {

namespace {

constexpr float kUniform = 0.75f;           // share of the density that ignores distance
constexpr std::size_t kMostExamined = 512;  // beyond so many lamps all count as equally important

}  // namespace

void LampPicker::aim(const Vec3& x, const Vec3& n, int rays) {
  const std::size_t count = lamps_->size();
  if (count <= kMostExamined)
    lamps_->importances(x, n, expected_);
  else
    std::fill(expected_.begin(), expected_.end(), 1.0f);
  candidates_.resize(count);
  std::size_t reachable = 0;
  float sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    candidates_[reachable] = static_cast<uint32_t>(i);
    reachable += expected_[i] > 0 ? 1 : 0;
    sum += expected_[i];
  }
  candidates_.resize(reachable);
  const float k = static_cast<float>(rays), m = static_cast<float>(reachable);
  if (m <= k) {
    for (const uint32_t i : candidates_) expected_[i] = 1;
    return;
  }
  const float even = k * kUniform / m, by_place = k * (1 - kUniform) / sum;
  for (const uint32_t i : candidates_) expected_[i] = std::min(1.0f, even + by_place * expected_[i]);
}

RayBudget shadow_ray_budget(std::size_t lamps) {
  const int n = static_cast<int>(std::min<std::size_t>(lamps, 64));
  return {std::clamp((n + 1) / 2, std::min(n, 8), 16), std::clamp((n + 2) / 3, 1, 8)};
}

}  // namespace sconce
