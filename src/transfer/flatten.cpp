// SPDX-License-Identifier: Apache-2.0
#include "transfer/flatten.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr int kMostRounds = 8;
constexpr float kPositions = 20, kNormals = 16;

using Place = std::array<float, 6>;
using Sums = std::array<double, 6>;

Place place_of(const SurfacePoint& p, float diagonal) {
  const Vec3 a = kPositions * p.position, b = kNormals * diagonal * p.shading_normal;
  return {a.x, a.y, a.z, b.x, b.y, b.z};
}

Sums centre(std::span<const Place> places, std::span<const uint32_t> members) {
  Sums sums{};
  for (const uint32_t i : members)
    for (std::size_t c = 0; c < 6; ++c) sums[c] += static_cast<double>(places[i][c]);
  for (double& v : sums) v /= static_cast<double>(std::max<std::size_t>(1, members.size()));
  return sums;
}

/// First principal axis by power iteration.
Sums principal_axis(std::span<const Place> places, std::span<const uint32_t> members) {
  const Sums middle = centre(places, members);
  std::array<Sums, 6> covariance{};
  for (const uint32_t i : members)
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b)
        covariance[a][b] +=
            (static_cast<double>(places[i][a]) - middle[a]) * (static_cast<double>(places[i][b]) - middle[b]);
  Sums axis{1, 0.9, 0.8, 0.7, 0.6, 0.5};
  for (int round = 0; round < 12; ++round) {
    Sums next{};
    double length = 0;
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) next[a] += covariance[a][b] * axis[b];
      length += next[a] * next[a];
    }
    if (!(length > 0)) break;
    for (std::size_t a = 0; a < 6; ++a) axis[a] = next[a] / std::sqrt(length);
  }
  return axis;
}

/// Orders members so that the first `left` are one half of the two.
void halve(std::span<const Place> places, std::span<uint32_t> members, std::size_t left,
           std::vector<std::pair<float, uint32_t>>& keys) {
  Sums axis = principal_axis(places, members);
  Sums before{};
  for (int round = 0; round < kMostRounds; ++round) {
    keys.clear();
    for (const uint32_t i : members) {
      double along = 0;
      for (std::size_t c = 0; c < 6; ++c) along += axis[c] * static_cast<double>(places[i][c]);
      keys.emplace_back(static_cast<float>(along), i);
    }
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(left), keys.end());
    for (std::size_t k = 0; k < members.size(); ++k) members[k] = keys[k].second;
    std::sort(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(left));
    std::sort(members.begin() + static_cast<std::ptrdiff_t>(left), members.end());
    const Sums a = centre(places, members.first(left)), b = centre(places, members.subspan(left));
    for (std::size_t c = 0; c < 6; ++c) axis[c] = b[c] - a[c];
    if (a == before) break;
    before = a;
  }
}

}  // namespace

std::vector<uint32_t> cluster_order(std::span<const SurfacePoint> points, std::size_t leaf, float diagonal) {
  std::vector<Place> places(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) { places[i] = place_of(points[i], diagonal); });
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::span<uint32_t>> parts{order};
  while (!parts.empty()) {
    std::vector<std::span<uint32_t>> halves(2 * parts.size());
    parallel_for(parts.size(), 1, [&](std::size_t p) {
      if (parts[p].size() <= leaf) return;
      const std::size_t leaves = (parts[p].size() + leaf - 1) / leaf, left = (leaves + 1) / 2 * leaf;
      std::vector<std::pair<float, uint32_t>> keys;
      halve(places, parts[p], left, keys);
      halves[2 * p] = parts[p].first(left);
      halves[2 * p + 1] = parts[p].subspan(left);
    });
    std::erase_if(halves, [&](const auto& half) { return half.size() <= leaf; });
    parts = std::move(halves);
  }
  return order;
}

}  // namespace sconce
