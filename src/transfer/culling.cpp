// SPDX-License-Identifier: Apache-2.0
#include "transfer/culling.h"

#include <Eigen/Dense>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr std::size_t kRank = ClusterRows::kRank, kLanes = ClusterRows::kLanes;

using Gram = Eigen::Matrix<double, kRank, kRank>;
using Column = Eigen::Matrix<double, kRank, 1>;

double largest_eigenvalue(const Gram& gram) {
  return Eigen::SelfAdjointEigenSolver<Gram>(gram, Eigen::EigenvaluesOnly).eigenvalues()(kRank - 1);
}

/// Squared spectral norm of a cluster's weights: the most that its rows make of its basis rows' answers.
double largest_square(const ClusterRows& rows, std::size_t cluster) {
  if (rows.plain()) return 1;
  Gram gram = Gram::Zero();
  const std::size_t end = std::min<std::size_t>(rows.rows, rows.cluster * (cluster + 1));
  for (std::size_t row = rows.cluster * cluster; row < end; ++row) {
    const std::size_t lane = row % kLanes;
    Column w;
    for (std::size_t j = 0; j < kRank; ++j)
      w(static_cast<Eigen::Index>(j)) =
          static_cast<double>(rows.scales[row]) * rows.weights[(row - lane) * kRank + j * kLanes + lane];
    gram += w * w.transpose();
  }
  return largest_eigenvalue(gram);
}

/// What coefficient k of a block, counted over all blocks, is to its basis rows.
Column column(const WaveletRows& basis, std::size_t block, uint32_t k) {
  Column out;
  for (std::size_t r = 0; r < kRank; ++r)
    out(static_cast<Eigen::Index>(r)) = static_cast<double>(basis.value(block, k, r));
  return out;
}

/// The same norm of a block's columns, each brought to length 1: 1 were they at right angles, their number
/// were they alike.
double largest_square_of_units(const WaveletRows& basis, std::size_t block) {
  Gram gram = Gram::Zero();
  for (uint32_t k = basis.first[block]; k < basis.first[block + 1]; ++k) {
    const Column c = column(basis, block, k);
    if (const double square = c.squaredNorm(); square > 0) gram += c * c.transpose() / square;
  }
  return largest_eigenvalue(gram);
}

float square_of(const Rgbx& l) {
  return l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
}

}  // namespace

Culling::Culling(const ClusterRows& rows) {
  const WaveletRows& basis = rows.basis;
  std::vector<double> most(basis.blocks()), alike(basis.blocks());
  std::vector<double> squares(basis.columns, 0.0), together(basis.columns, 0.0);
  parallel_for(most.size(), 16, [&](std::size_t c) {
    most[c] = largest_square(rows, c);
    alike[c] = largest_square_of_units(basis, c);
  });
  for (std::size_t block = 0; block < basis.blocks(); ++block) {
    for (uint32_t k = basis.first[block]; k < basis.first[block + 1]; ++k) {
      const double square = most[block] * column(basis, block, k).squaredNorm();
      squares[basis.indices[k]] += square;
      together[basis.indices[k]] += alike[block] * square;
    }
    for (std::size_t r = 0; r < kRank; ++r) {
      const auto mean = static_cast<double>(basis.means[kRank * block + r]);
      squares[0] += most[block] * mean * mean;
    }
  }
  for (const double s : squares) norms_.push_back(static_cast<float>(std::sqrt(s)));
  squares_.assign(together.begin(), together.end());
}

Culling::Report Culling::apply(float share, std::span<Rgbx> light) const {
  struct Part {
    Report report;
    double squares = 0;
  };
  constexpr std::size_t kPart = 4096;
  std::vector<Part> parts((light.size() + kPart - 1) / kPart);
  const float least = share * norms_[0] * std::sqrt(square_of(light[0]));
  parallel_for(parts.size(), 1, [&](std::size_t p) {
    Part own;
    for (std::size_t c = std::max<std::size_t>(1, kPart * p); c < std::min(light.size(), kPart * (p + 1));
         ++c) {
      if (!(norms_[c] > 0)) continue;
      ++own.report.of;
      const float size = norms_[c] * std::sqrt(square_of(light[c]));
      if (!(size < least)) continue;
      own.report.bound += static_cast<double>(size);
      own.squares += static_cast<double>(squares_[c] * square_of(light[c]));
      ++own.report.culled;
      light[c] = {};
    }
    parts[p] = own;
  });
  Report report;
  double squares = 0;
  for (const Part& part : parts) {
    report.culled += part.report.culled, report.of += part.report.of, report.bound += part.report.bound;
    squares += part.squares;
  }
  report.bound = std::min(report.bound, std::sqrt(squares));
  return report;
}

}  // namespace sconce
