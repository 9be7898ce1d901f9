// SPDX-License-Identifier: Apache-2.0
// Light that an operator is fitted to: what lamps at many places throw onto the cloud. It tells which light
// to expect, and with that which coefficients matter and what the ones left out would have added.
#pragma once

#include "transfer/haar.h"

namespace sconce {

class TrainingLight {
 public:
  /// Coarsest coefficients, which carry what the others leave out.
  static constexpr std::size_t kCoarse = 256;

  /// @param lights  transformed squares of n, one value each; brought to equal strength here
  explicit TrainingLight(std::vector<std::vector<float>> lights);

  std::size_t count() const { return count_; }
  uint32_t columns() const { return static_cast<uint32_t>(squares_.size()); }
  std::size_t coarse() const { return coarse_; }
  /// Values of all lights at one column (slot), or of one wavelet coefficient.
  std::span<const float> at_column(uint32_t column) const { return of(columns_, column); }
  std::span<const float> at_coefficient(uint32_t coefficient) const { return of(coefficients_, coefficient); }
  /// Expected square per coefficient: of the lights, evened out over its level.
  const std::vector<float>& squares() const { return squares_; }
  /// coarse x lights: makes residuals (lights x any) into what coarse coefficients should add, by ridge
  /// regression.
  std::span<const float> fit() const { return fit_; }

 private:
  std::span<const float> of(const std::vector<float>& all, uint32_t i) const {
    return {all.data() + count_ * i, count_};
  }
  std::size_t count_, coarse_ = 0;
  std::vector<float> columns_, coefficients_, squares_, fit_;
};

}  // namespace sconce
