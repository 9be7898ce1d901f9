// SPDX-License-Identifier: Apache-2.0
// Two bakes of the same atlas, texel by texel: contract.md's relative RMSE without its boxes, which would
// join charts.
#pragma once

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

/// Interior texels: neither the texel nor its eight neighbours are cut by the edge of a chart or partly
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
/// @throws Error when groups or atlas differ
inline std::vector<LightmapError> lightmap_errors(const Package& package, const Package& s0,
                                                  const Package& s1) {
  const Manifest& m = package.manifest();
  for (const Package* other : {&s0, &s1}) {
    const Manifest& o = other->manifest();
    if (o.width != m.width || o.height != m.height || o.pages != m.pages ||
        o.groups.size() != m.groups.size())
      throw Error(other->path().string(),
                  "has another atlas or other groups than " + package.path().string());
  }
  std::vector<LightmapError> result;
  std::vector<std::vector<uint8_t>> inside;
  for (int p = 0; p < m.pages; ++p) inside.push_back(interior_texels(package.receivers(p)));
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    LightmapError error;
    error.group = m.groups[g].name;
    double squares = 0, noise = 0, mean = 0, luma = 0, reference_luma = 0;
    for (int p = 0; p < m.pages; ++p) {
      const Image a = package.layer(g, p), b0 = s0.layer(g, p), b1 = s1.layer(g, p);
      for (std::size_t i = 0; i < inside[static_cast<std::size_t>(p)].size(); ++i) {
        if (inside[static_cast<std::size_t>(p)][i] == 0) continue;
        ++error.texels;
        for (std::size_t c = 0; c < 3; ++c) {
          const double v0 = static_cast<double>(b0.data[3 * i + c]),
                       v1 = static_cast<double>(b1.data[3 * i + c]);
          const double d = static_cast<double>(a.data[3 * i + c]) - (v0 + v1) / 2;
          squares += d * d;
          noise += (v0 - v1) * (v0 - v1) / 4;
          mean += (v0 + v1) / 2;
        }
        luma += static_cast<double>(luminance(Rgb(a.data[3 * i], a.data[3 * i + 1], a.data[3 * i + 2])));
        for (const Image* b : {&b0, &b1})
          reference_luma += 0.5 * static_cast<double>(
                                      luminance(Rgb(b->data[3 * i], b->data[3 * i + 1], b->data[3 * i + 2])));
      }
    }
    const double n = 3 * static_cast<double>(error.texels);
    error.mean_ratio = luma / reference_luma;
    error.rmse = std::sqrt(std::max(0.0, squares - noise) / n) / (mean / n);
    error.noise = std::sqrt(noise / n) / (mean / n);
    result.push_back(error);
  }
  return result;
}

}  // namespace sconce::test
