// SPDX-License-Identifier: Apache-2.0
// A matrix whose rows come in clusters of neighbours: each row is a combination of its cluster's sixteen
// basis rows, and these are wavelet rows (methods.md 2.5, "clustered low rank + wavelet basis"). Or plain
// wavelet rows, in the same form.
#pragma once

#include "transfer/training.h"
#include "transfer/wavelet_rows.h"

namespace sconce {

/// Arrays may lie in a file's bytes; whoever made the rows keeps them alive.
struct ClusterRows {
  static constexpr std::size_t kRank = WaveletRows::kBlock, kLanes = 16;

  uint32_t rows = 0, cluster = 0;    ///< rows, and rows per cluster: a multiple of kLanes; the last has fewer
  WaveletRows basis;                 ///< kRank per cluster: one block
  std::span<const int16_t> weights;  ///< per kLanes rows (filled up): kRank x kLanes; none of plain rows
  std::span<const float> scales;     ///< per row, filled up: of its weights, 1/32767 included

  /// Rows are the basis rows themselves, kLanes per cluster.
  bool plain() const { return weights.empty(); }
  std::size_t clusters() const { return cluster == 0 ? 0 : (rows + cluster - 1) / cluster; }
  uint64_t bytes() const { return basis.bytes() + weights.size_bytes() + scales.size_bytes(); }
  /// Multiplications of a product per row, and channel.
  double macs_per_row() const {
    return rows == 0 ? 0
                     : static_cast<double>(weights.size() + basis.codes.size() + basis.means.size()) / rows;
  }
};

/// rows x light, where the light is a transformed square. The same bits at any number of threads.
/// @param light  columns
/// @param out    rows
void multiply(const ClusterRows& rows, std::span<const Rgbx> light, std::span<Rgb> out,
              Zeros zeros = Zeros::multiply);

/// The second half of it: rows out of the answers of their clusters' basis rows.
/// @param basis  kRank per cluster
void combine(const ClusterRows& rows, std::span<const Rgb> basis, std::span<Rgb> out);

/// Fits rows cluster by cluster to light as it is expected, on any number of threads.
class ClusterRowsBuilder {
 public:
  struct Params {
    uint32_t cluster = 512;
    std::size_t coefficients = 1024;  ///< of a basis
    bool keep_sums = false;  ///< of rows, exactly: even light stays so whatever the training lights are
    /// How much alike rows count, whatever light they see: their errors are weighed by 1 / (its
    /// norm)^evenness. At 0 the basis is spent on the brightest rows, and dim ones lose light.
    float evenness = 0.7f;
  };
  /// @param light  must outlive it
  ClusterRowsBuilder(uint32_t rows, const TrainingLight& light, const Params& params);

  std::size_t clusters() const { return basis_.blocks(); }
  /// Rows of a cluster as they were shot.
  /// @param rows  sparse rows, ascending by column: `cluster` of them, fewer in the last
  void set_cluster(std::size_t cluster, std::span<const std::vector<SparseEntry>> rows);
  /// A finished cluster as bytes, for another builder of the same rows.
  void pack(std::size_t cluster, std::string& bytes) const;
  void unpack(std::size_t cluster, std::string_view& bytes);
  struct Result {
    ClusterRows rows;
    std::shared_ptr<const void> owner;
  };
  Result finish();

 private:
  /// What belongs to a cluster.
  template <class Values>
  auto part(Values& all, std::size_t cluster, std::size_t per_row) const {
    const std::size_t size = params_.cluster * per_row, first = cluster * size;
    return std::span(all).subspan(first, std::min(size, all.size() - first));
  }

  uint32_t rows_;
  const TrainingLight& light_;
  Params params_;
  WaveletRowsBuilder basis_;
  std::vector<int16_t> weights_;
  std::vector<float> scales_;
};

}  // namespace sconce
