// SPDX-License-Identifier: Apache-2.0
#include "transfer/folded_bounces.h"

#include <Eigen/Dense>

#include "core/parallel.h"

namespace sconce {

namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

FoldedBounces::FoldedBounces(const Operator& op)
    : op_(op), rank_(op.sweeps > 1 && !op.bounce.plain() ? ClusterRows::kRank * op.bounce.clusters() : 0) {
  if (rank_ == 0) return;
  const ClusterRows& k = op.bounce;
  const auto n = static_cast<Eigen::Index>(rank_);
  std::array<Matrix, 3> c{Matrix(n, n), Matrix(n, n), Matrix(n, n)};
  parallel_for(rank_, 1, [&](std::size_t column) {
    // What a unit of this basis row's answer becomes: rho W, and that seen by all basis rows.
    const std::size_t cluster = column / ClusterRows::kRank, j = column % ClusterRows::kRank;
    std::vector<Rgbx> light(k.rows, Rgbx{});
    for (std::size_t row = cluster * k.cluster;
         row < std::min<std::size_t>(k.rows, (cluster + 1) * k.cluster); ++row) {
      const std::size_t lane = row % ClusterRows::kLanes;
      const float weight =
          k.scales[row] *
          static_cast<float>(k.weights[(row - lane) * ClusterRows::kRank + j * ClusterRows::kLanes + lane]);
      for (std::size_t ch = 0; ch < 3; ++ch) light[row][ch] = op.albedo[row][ch] * weight;
    }
    haar_forward(light);
    std::vector<Rgb> seen(rank_);
    multiply(k.basis, light, seen);
    for (std::size_t i = 0; i < rank_; ++i) {
      const auto r = static_cast<Eigen::Index>(i), s = static_cast<Eigen::Index>(column);
      c[0](r, s) = seen[i].r, c[1](r, s) = seen[i].g, c[2](r, s) = seen[i].b;
    }
  });
  parallel_for(3, 1, [&](std::size_t ch) {
    sums_[ch].resize(rank_ * rank_);
    Eigen::Map<Matrix>(sums_[ch].data(), n, n) = (Matrix::Identity(n, n) - c[ch]).partialPivLu().inverse();
  });
}

void FoldedBounces::apply(std::span<Rgbx> exitance) const {
  if (rank_ == 0) return bounce_light(op_, exitance);
  weigh(op_, exitance);
  haar_forward(exitance);
  // Light that was reflected once: all of it goes on, and what its bounces add comes through K once more.
  std::vector<Rgbx> once = reflected_once(op_, exitance);
  std::vector<Rgbx> sum = once;
  haar_forward(once);
  std::vector<Rgb> seen(rank_), all(rank_);
  multiply(op_.bounce.basis, once, seen);
  parallel_for(rank_, 64, [&](std::size_t i) {
    const float *red = &sums_[0][i * rank_], *green = &sums_[1][i * rank_], *blue = &sums_[2][i * rank_];
    Rgb out;
    for (std::size_t j = 0; j < rank_; ++j)
      out += Rgb(red[j] * seen[j].r, green[j] * seen[j].g, blue[j] * seen[j].b);
    all[i] = out;
  });
  std::vector<Rgb> illuminance(op_.bounce.rows);
  combine(op_.bounce, all, illuminance);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Rgb& e = illuminance[i];
    for (std::size_t ch = 0; ch < 3; ++ch) {
      const float value = ch == 0 ? e.r : ch == 1 ? e.g : e.b;
      sum[i][ch] += op_.albedo[i][ch] * value;
    }
  }
  add_reflected(exitance, sum);
}

namespace {

void clamp(std::span<Rgb> light) {
  for (Rgb& e : light) e = Rgb(std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f));
}

}  // namespace

void FoldedBounces::indirect(std::span<Rgbx> exitance, std::span<Rgb> out) const {
  apply(exitance);
  multiply(op_.gather, exitance, out);
  clamp(out);
}

Culling::Report FoldedBounces::indirect(std::span<Rgbx> exitance, std::span<Rgb> out, const Culling& culling,
                                        float share) const {
  apply(exitance);
  const Culling::Report report = culling.apply(share, exitance);
  multiply(op_.gather, exitance, out, report.culled > 0 ? Zeros::skip : Zeros::multiply);
  clamp(out);
  return report;
}

}  // namespace sconce
