// SPDX-License-Identifier: Apache-2.0
// Wavelet coefficients of light that hardly matter are left out of a product (the chapter's on-the-fly
// culling, 9.8.3), with a bound that holds: methods.md, erratum C6.
#pragma once

#include "transfer/cluster_rows.h"

namespace sconce {

class Culling {
 public:
  /// Norms of the columns: what one unit of each coefficient does to all rows. Reads all of them once.
  explicit Culling(const ClusterRows& rows);

  struct Report {
    std::size_t culled = 0;  ///< coefficients of those that any row has
    std::size_t of = 0;
    /// Largest possible error of the product, as the root of the sum of squares over all rows and channels.
    /// Columns share rows, so that norms add, or squares times what a cluster makes of unit columns at most:
    /// the lesser.
    double bound = 0;
  };
  /// Sets to 0 the coefficients that change the rows less than `share` of what the mean does.
  /// @param light  columns
  Report apply(float share, std::span<Rgbx> light) const;

  std::span<const float> norms() const { return norms_; }

 private:
  std::vector<float> norms_, squares_;
};

}  // namespace sconce
