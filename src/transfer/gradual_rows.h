// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transfer/cluster_rows.h"

namespace sconce {

/// A product of rows and light that is made over several frames. At once each cluster's mean is right, which
/// is a row of its own; how light differs within the cluster stays as it was until it is its turn.
class GradualRows {
 public:
  /// @param rows  must outlive it
  explicit GradualRows(const ClusterRows& rows);

  /// Begins anew. @param light  transformed. @param out  rows: what the last light gave, changed
  void start(std::span<const Rgbx> light, std::span<Rgb> out);
  /// Makes the next clusters exact, at least one, as long as there are any and they have no more than `rows`
  /// rows: then the same bits as multiply().
  /// @param light  as at the start
  void refine(std::span<const Rgbx> light, std::size_t rows, std::span<Rgb> out);
  /// Rows that are not exact yet.
  std::size_t left() const { return next_ >= rows_.clusters() ? 0 : rows_.rows - next_ * rows_.cluster; }

 private:
  const ClusterRows& rows_;
  std::vector<float> means_;  ///< per coefficient of the bases: of the cluster's mean row
  std::vector<float> evens_;  ///< per cluster: its coefficient 0
  std::size_t next_;          ///< cluster
};

}  // namespace sconce
