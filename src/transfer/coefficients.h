// SPDX-License-Identifier: Apache-2.0
// Which wavelet coefficients of matrix rows are kept.
#pragma once

#include <array>
#include <string_view>

#include "transfer/haar.h"

namespace sconce {

/// What |coefficient| is multiplied by before the largest are kept: how strong light is expected to be in it.
/// Right for light that varies smoothly is the area of the wavelet's support (the chapter's choice, after Ng
/// et al. 2003); lamps with edges and shadows measure nearer to its square root (methods.md 2.5).
enum class Weighting : uint8_t { root_area, area, none };

struct WeightingRow {
  std::string_view name;
  Weighting weighting;
};
inline constexpr std::array<WeightingRow, 3> kWeightings{
    {{"root-area", Weighting::root_area}, {"area", Weighting::area}, {"none", Weighting::none}}};

/// Squares of these weights, per coefficient of a square of n.
std::vector<float> squared_weights(uint32_t n, Weighting weighting);

/// Chooses one set of coefficients for several rows. Keeps its scratch, so that many choices are cheap.
class CoefficientChooser {
 public:
  /// @param squares  per coefficient: by what a sum of squares is multiplied; must outlive it
  explicit CoefficientChooser(std::span<const float> squares)
      : squares_(squares), scores_(squares.size(), 0.0f) {}

  /// Of one row, or the sum over several.
  void add(uint32_t coefficient, float square);
  /// The `count` details with the largest weighted sums since the last choice; ties by index. The mean (0) is
  /// not among them: it is always kept.
  /// @return ascending; fewer where fewer were added. Valid until the next choice
  std::span<const uint32_t> choose(std::size_t count);

 private:
  std::span<const float> squares_;
  std::vector<float> scores_;  ///< per coefficient; all 0 between choices
  std::vector<uint32_t> touched_, chosen_;
};

}  // namespace sconce
