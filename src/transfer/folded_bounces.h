// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transfer/culling.h"
#include "transfer/operator.h"

namespace sconce {

/// All bounces of an operator in one step. K has few basis rows: K = W B, weights times basis, so that the
/// sum of its powers is that of a small matrix C = B rho W between basis rows, and that sum is (I - C)^-1.
/// Costs a second to make and then a product with a matrix of a few hundred rows instead of one for every
/// sweep. Equals bounce_light() after as many sweeps as change nothing; is bounce_light() where K's rows are
/// plain, as many basis rows as nodes.
class FoldedBounces {
 public:
  /// @param op  must outlive it
  explicit FoldedBounces(const Operator& op);

  /// As bounce_light(): b_d becomes the wavelet coefficients of (M + I) b_d, weighed. In place.
  void apply(std::span<Rgbx> exitance) const;
  /// Illuminance by light that was reflected at least once, lux; per receiver. What truncated rows leave
  /// below zero is darkness.
  void indirect(std::span<Rgbx> exitance, std::span<Rgb> out) const;
  /// The same, but for coefficients that hardly matter. @param culling  of the operator's `gather`
  /// @return `bound` holds for it, too: darkness is no further from what is right than what is below zero
  Culling::Report indirect(std::span<Rgbx> exitance, std::span<Rgb> out, const Culling& culling,
                           float share) const;

  /// The small matrix of a channel, by rows: for other devices. None where one sweep is all.
  std::span<const float> matrix(std::size_t channel) const { return sums_[channel]; }

 private:
  const Operator& op_;
  std::size_t rank_;                        ///< basis rows of `bounce`, where it is used
  std::array<std::vector<float>, 3> sums_;  ///< per channel: (I - C)^-1, by rows
};

}  // namespace sconce
