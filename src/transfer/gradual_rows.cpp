// SPDX-License-Identifier: Apache-2.0
#include "transfer/gradual_rows.h"

#include <algorithm>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr std::size_t kRank = ClusterRows::kRank, kLanes = ClusterRows::kLanes;

/// Clusters [first, first + count) as rows of their own.
ClusterRows part(const ClusterRows& rows, std::size_t first, std::size_t count) {
  ClusterRows out = rows;
  const std::size_t row = first * rows.cluster;
  out.rows = static_cast<uint32_t>(std::min<std::size_t>(rows.rows - row, count * rows.cluster));
  out.basis.rows = static_cast<uint32_t>(kRank * count);
  out.basis.first = rows.basis.first.subspan(first, count + 1);
  out.basis.scales = rows.basis.scales.subspan(kRank * first, kRank * count);
  out.basis.means = rows.basis.means.subspan(kRank * first, kRank * count);
  if (rows.plain()) return out;
  const std::size_t filled = (out.rows + kLanes - 1) / kLanes * kLanes;
  out.weights = rows.weights.subspan(kRank * row, kRank * filled);
  out.scales = rows.scales.subspan(row, filled);
  return out;
}

std::size_t rows_of(const ClusterRows& rows, std::size_t cluster) {
  return std::min<std::size_t>(rows.cluster, rows.rows - cluster * rows.cluster);
}

/// How much of each basis row is in a cluster's mean row.
std::array<double, kRank> mean_weights(const ClusterRows& rows, std::size_t cluster) {
  std::array<double, kRank> out{};
  const std::size_t first = cluster * rows.cluster, count = rows_of(rows, cluster);
  for (std::size_t i = first; i < first + count; ++i) {
    const std::size_t lane = i % kLanes;
    for (std::size_t j = 0; j < kRank; ++j)
      out[j] += rows.plain() ? (i - first == j ? 1.0 : 0.0)
                             : static_cast<double>(rows.scales[i]) *
                                   static_cast<double>(rows.weights[(i - lane) * kRank + j * kLanes + lane]);
  }
  for (double& w : out) w /= static_cast<double>(count);
  return out;
}

}  // namespace

GradualRows::GradualRows(const ClusterRows& rows)
    : rows_(rows), means_(rows.basis.indices.size()), evens_(rows.clusters()), next_(rows.clusters()) {
  parallel_for(rows.clusters(), 1, [&](std::size_t c) {
    const std::array<double, kRank> weights = mean_weights(rows, c);
    for (std::size_t j = 0; j < kRank; ++j)
      evens_[c] += static_cast<float>(weights[j] * static_cast<double>(rows.basis.means[kRank * c + j]));
    for (uint32_t k = rows.basis.first[c]; k < rows.basis.first[c + 1]; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < kRank; ++j)
        sum += weights[j] * static_cast<double>(rows.basis.value(c, k, j));
      means_[k] = static_cast<float>(sum);
    }
  });
}

void GradualRows::start(std::span<const Rgbx> light, std::span<Rgb> out) {
  next_ = 0;
  parallel_for(rows_.clusters(), 16, [&](std::size_t c) {
    Rgbx sum = light[0];
    for (float& v : sum) v *= evens_[c];
    for (uint32_t k = rows_.basis.first[c]; k < rows_.basis.first[c + 1]; ++k) {
      const Rgbx& l = light[rows_.basis.indices[k]];
      for (std::size_t ch = 0; ch < 4; ++ch) sum[ch] += means_[k] * l[ch];
    }
    const std::span<Rgb> own = out.subspan(c * rows_.cluster, rows_of(rows_, c));
    Rgb before;
    for (const Rgb& v : own) before += v;
    before *= 1 / static_cast<float>(own.size());
    // What is dark cannot be scaled.
    const auto channel = [](float& value, float mean, float now) {
      if (mean > 1e-3f * now)
        value *= now / mean;
      else
        value = now;
    };
    const Rgb now(std::max(sum[0], 0.0f), std::max(sum[1], 0.0f), std::max(sum[2], 0.0f));
    for (Rgb& v : own)
      channel(v.r, before.r, now.r), channel(v.g, before.g, now.g), channel(v.b, before.b, now.b);
  });
}

void GradualRows::refine(std::span<const Rgbx> light, std::size_t rows, std::span<Rgb> out) {
  if (left() == 0) return;
  const std::size_t count = std::clamp<std::size_t>(rows / rows_.cluster, 1, rows_.clusters() - next_);
  const ClusterRows some = part(rows_, next_, count);
  multiply(some, light, out.subspan(next_ * rows_.cluster, some.rows));
  next_ += count;
}

}  // namespace sconce
