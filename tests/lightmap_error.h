// SPDX-License-Identifier: Apache-2.0
// Two bakes of the same atlas, texel by texel: contract.md's relative RMSE without its boxes, which would
// join charts.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "package/package.h"

namespace sconce::test {

struct LightmapError {
  std::string group;
  double mean_ratio = 1;  ///< mean luminance / of the reference
  double rmse = 0;        ///< relative to the reference's mean, freed of its noise
  double noise = 0;       ///< relative standard error of the reference
  std::size_t texels = 0;
};

/// Interior texels: neither the texel nor its eight neighbours are cut by the edge of a chart or wholly
/// buried, so that their weights (surface area) agree within 10 %. Elsewhere bakers differ in what part of a
/// texel counts.
inline std::vector<uint8_t> interior_texels(const Image& receivers) {
  const int weight = receivers.channel("weight");
  std::vector<uint8_t> inside(receivers.pixels(), 0);
  for (int y = 1; y + 1 < receivers.height; ++y)
    for (int x = 1; x + 1 < receivers.width; ++x) {
      float least = receivers.at(x, y)[weight], most = least;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          least = std::min(least, receivers.at(x + dx, y + dy)[weight]);
          most = std::max(most, receivers.at(x + dx, y + dy)[weight]);
        }
      inside[static_cast<std::size_t>(y) * static_cast<std::size_t>(receivers.width) +
             static_cast<std::size_t>(x)] = least > 0.9f * most;
    }
  return inside;
}

/// Over interior texels and channels, with r = (s0 + s1) / 2:
///   rmse = sqrt(max(0, mean (package - r)^2 - mean (s0 - s1)^2 / 4)) / mean r
/// @param s0, s1  independent bakes of the reference
/// @param drop  share of texels, those of the largest error, to leave out: one firefly else decides the
/// figure
/// @throws Error when groups or atlas differ
inline std::vector<LightmapError> lightmap_errors(const Package& package, const Package& s0,
                                                  const Package& s1, double drop = 0) {
  const Manifest& m = package.manifest();
  for (const Package* other : {&s0, &s1}) {
    const Manifest& o = other->manifest();
    if (o.width != m.width || o.height != m.height || o.pages != m.pages ||
        o.groups.size() != m.groups.size())
      throw Error(other->path().string(),
                  "has another atlas or other groups than " + package.path().string());
  }
  struct Texel {  // sums over channels
    double square = 0, noise = 0, reference = 0, luma = 0, reference_luma = 0;
  };
  const auto luma = [](const Image& image, std::size_t i) {
    return static_cast<double>(
        luminance(Rgb(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2])));
  };
  std::vector<std::vector<uint8_t>> inside;
  for (int p = 0; p < m.pages; ++p) inside.push_back(interior_texels(package.receivers(p)));
  std::vector<LightmapError> result;
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    std::vector<Texel> texels;
    for (int p = 0; p < m.pages; ++p) {
      const Image a = package.layer(g, p), b0 = s0.layer(g, p), b1 = s1.layer(g, p);
      for (std::size_t i = 0; i < inside[static_cast<std::size_t>(p)].size(); ++i) {
        if (inside[static_cast<std::size_t>(p)][i] == 0) continue;
        Texel texel;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
          const double v0 = static_cast<double>(b0.data[c]), v1 = static_cast<double>(b1.data[c]);
          const double d = static_cast<double>(a.data[c]) - (v0 + v1) / 2;
          texel.square += d * d;
          texel.noise += (v0 - v1) * (v0 - v1) / 4;
          texel.reference += (v0 + v1) / 2;
        }
        texel.luma = luma(a, i);
        texel.reference_luma = (luma(b0, i) + luma(b1, i)) / 2;
        texels.push_back(texel);
      }
    }
    std::stable_sort(texels.begin(), texels.end(),
                     [](const Texel& x, const Texel& y) { return x.square < y.square; });
    texels.resize(texels.size() - static_cast<std::size_t>(drop * static_cast<double>(texels.size())));
    Texel sum;
    for (const Texel& texel : texels) {
      sum.square += texel.square, sum.noise += texel.noise, sum.reference += texel.reference;
      sum.luma += texel.luma, sum.reference_luma += texel.reference_luma;
    }
    const double n = 3 * static_cast<double>(texels.size()), mean = sum.reference / n;
    result.push_back({m.groups[g].name, sum.luma / sum.reference_luma,
                      std::sqrt(std::max(0.0, sum.square - sum.noise) / n) / mean,
                      std::sqrt(sum.noise / n) / mean, texels.size()});
  }
  return result;
}

}  // namespace sconce::test
