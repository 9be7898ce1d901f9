// SPDX-License-Identifier: Apache-2.0
#include "transfer/culling.h"

#include <Eigen/Dense>

#include "core/parallel.h"
#include "transfer/quantise.h"

namespace sconce {

namespace {

constexpr std::size_t kRank = ClusterRows::kRank, kLanes = ClusterRows::kLanes;

/// Squared spectral norm of a cluster's weights: the most that its rows make of its basis rows' answers.
double largest_square(const ClusterRows& rows, std::size_t cluster) {
  if (rows.plain()) return 1;
  Eigen::Matrix<double, kRank, kRank> gram = Eigen::Matrix<double, kRank, kRank>::Zero();
  const std::size_t end = std::min<std::size_t>(rows.rows, rows.cluster * (cluster + 1));
  for (std::size_t row = rows.cluster * cluster; row < end; ++row) {
    const std::size_t lane = row % kLanes;
    Eigen::Matrix<double, kRank, 1> w;
    for (std::size_t j = 0; j < kRank; ++j)
      w(static_cast<Eigen::Index>(j)) =
          static_cast<double>(rows.scales[row]) * rows.weights[(row - lane) * kRank + j * kLanes + lane];
    gram += w * w.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kRank, kRank>>(gram).eigenvalues()(kRank - 1);
}

float size_of(const Rgbx& l) {
  return std::sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
}

}  // namespace

Culling::Culling(const ClusterRows& rows) {
  const WaveletRows& basis = rows.basis;
  std::vector<double> most(basis.blocks()), squares(basis.columns, 0.0);
  parallel_for(most.size(), 16, [&](std::size_t c) { most[c] = largest_square(rows, c); });
  for (std::size_t block = 0; block < basis.blocks(); ++block) {
    const float* scales = basis.scales.data() + kRank * block;
    for (uint32_t k = basis.first[block]; k < basis.first[block + 1]; ++k) {
      double sum = 0;
      for (std::size_t r = 0; r < kRank; ++r) {
        const auto value = static_cast<double>(dequantise(basis.codes[kRank * k + r], scales[r]));
        sum += value * value;
      }
      squares[basis.indices[k]] += most[block] * sum;
    }
    for (std::size_t r = 0; r < kRank; ++r) {
      const auto mean = static_cast<double>(basis.means[kRank * block + r]);
      squares[0] += most[block] * mean * mean;
    }
  }
  for (const double s : squares) norms_.push_back(static_cast<float>(std::sqrt(s)));
}

Culling::Report Culling::apply(float share, std::span<Rgbx> light) const {
  Report report;
  const float least = share * norms_[0] * size_of(light[0]);
  for (std::size_t c = 1; c < light.size(); ++c) {
    if (!(norms_[c] > 0)) continue;
    ++report.of;
    const float size = norms_[c] * size_of(light[c]);
    if (!(size < least)) continue;
    report.bound += static_cast<double>(size);
    ++report.culled;
    light[c] = {};
  }
  return report;
}

}  // namespace sconce
