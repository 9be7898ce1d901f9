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

/// Chooses one set of coefficients for several rows. Keeps its scratch, so that many choices are cheap.
class CoefficientChooser {
 public:
  /// @param n  columns, a power of four
  CoefficientChooser(uint32_t n, Weighting weighting);

  /// The `count` details with the largest sum of squares over the rows, weighted; ties by index. The mean (0)
  /// is not among them: it is always kept.
  /// @return ascending; fewer where rows have fewer. Valid until the next call
  std::span<const uint32_t> choose(std::span<const std::vector<SparseEntry>> rows, std::size_t count);

 private:
  std::array<float, 17> weights_{};  ///< by level, squared
  std::vector<float> scores_;        ///< per coefficient; all 0 between calls
  std::vector<uint32_t> touched_;
};

}  // namespace sconce
