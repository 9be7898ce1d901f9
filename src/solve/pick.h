// SPDX-License-Identifier: Apache-2.0
// Which lamps get a shadow ray at a path vertex. The density is a function of the lamps and the place alone,
// never of grouping or strength (contract.md, "Which lamp is sampled").
#pragma once

#include <vector>

#include "light/lamp.h"

namespace sconce {

class LampPicker {
 public:
  explicit LampPicker(const Lamps& lamps) : lamps_(&lamps), expected_(lamps.size()) {}

  /// Decides how often each lamp is sampled at (x, n), 0 or 1 times, about `rays` in all; n = 0: all around.
  void aim(const Vec3& x, const Vec3& n, int rays);
  /// Expected number of samples of lamp i at the last aim(): the factor of its density in MIS weights.
  float expected(std::size_t i) const { return expected_[i]; }
  /// Calls f(lamp, expected) for the lamps picked by one uniform number: systematic sampling, so a lamp with
  /// expectation 1 is always picked and the number of rays hardly varies.
  template <class F>
  void pick(float u, F&& f) const {
    float sum = 0, next = u;
    for (const uint32_t i : candidates_) {
      sum += expected_[i];
      if (sum > next) {
        next += 1;
        f(i, expected_[i]);
      }
    }
  }

 private:
  const Lamps* lamps_;
  std::vector<float> expected_;
  std::vector<uint32_t> candidates_;
};

/// Shadow rays at the receiver and at later vertices for a scene of n lamps: enough that no lamp is rarer
/// than about one in three, which bounds its noise at twice that of a bake of this lamp alone.
struct RayBudget {
  int receiver, bounce;
};
RayBudget shadow_ray_budget(std::size_t lamps);

}  // namespace sconce
