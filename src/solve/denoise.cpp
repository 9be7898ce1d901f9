// SPDX-License-Identifier: Apache-2.0
#include "solve/denoise.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr std::size_t kChunk = 4096;  // texels per walk: its scratch is as long as the graph

/// What one group is taken to be at a texel while weights are made.
struct Guide {
  float value = 0;     ///< luminance, lux
  float variance = 0;  ///< of its noise
};

/// A filter's reach, and how large a difference of guides counts as none.
struct Pass {
  float radius;  ///< spacings
  float free;    ///< in variances
};
// Single texels are too noisy to be compared closely; each pass lends the next one a cleaner guide. All
// filter the raw values. Radii and strictness were chosen by bench/denoise_main.cpp.
constexpr Pass kPasses[] = {{1.8f, 13}, {3, 2}, {9, 2}};
constexpr float kStrictness = 0.2f;  // of a weight's fall with the squared difference, in variances
constexpr float kVarianceRadius = 3;
// What a texel's variance can be at most: so many times what it says, and this share of its neighbours'.
constexpr float kMostDoubt = 16, kLeastDoubt = 0.05f;

class Filter {
 public:
  Filter(const TexelGraph& graph, std::span<const std::vector<GroupValue>> values, std::size_t guides)
      : graph_(graph), layers_(values.size()), groups_(guides), raw_(graph.size() * layers_) {
    for (std::size_t l = 0; l < layers_; ++l)
      for (std::size_t i = 0; i < graph.size(); ++i) raw_[i * layers_ + l] = values[l][i];
    // The largest of n squared normal numbers is about 2 ln n.
    free_ = 2 * std::log(static_cast<float>(groups_));
    smooth_variances();
  }

  std::vector<std::vector<GroupValue>> run(const Progress& progress) {
    std::vector<std::vector<GroupValue>> out(layers_, std::vector<GroupValue>(graph_.size()));
    for (const Pass& pass : kPasses) {
      std::vector<Guide> next(guides_.size());
      for_each_texel(progress, [&](std::size_t i, TexelWalk& walk, std::vector<double>& weights) {
        filter(i, pass, walk, weights, out, next);
      });
      guides_ = std::move(next);
    }
    return out;
  }

 private:
  template <class F>
  void for_each_texel(const Progress& progress, const F& f) const {
    parallel_for((graph_.size() + kChunk - 1) / kChunk, 1, [&](std::size_t chunk) {
      progress.check();
      TexelWalk walk(graph_);
      std::vector<double> weights;
      const std::size_t end = std::min(graph_.size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < end; ++i) f(i, walk, weights);
    });
  }

  // Eight batches tell a texel's error to a quarter only, and a texel that missed what is rare believes in 0:
  // its neighbours know better. But one in the shadow is not as noisy as what lies in the light beside it.
  void smooth_variances() {
    variances_.resize(graph_.size() * groups_);
    guides_.resize(variances_.size());
    for_each_texel({}, [&](std::size_t i, TexelWalk& walk, std::vector<double>&) {
      const std::span<const TexelStep> steps = walk.around(i, kVarianceRadius);
      for (std::size_t g = 0; g < groups_; ++g) {
        float sum = 0, weight = 0;
        for (const TexelStep& step : steps) {
          const float error = raw_[step.node * layers_ + g].error;
          sum += step.weight * error * error;
          weight += step.weight;
        }
        const float mean = sum / weight, own = raw_[i * layers_ + g].error;
        const float variance = std::min(mean, kMostDoubt * own * own + kLeastDoubt * mean);
        variances_[i * groups_ + g] = variance;
        guides_[i * groups_ + g] = {luminance(raw_[i * layers_ + g].illuminance), variance};
      }
    });
  }

  void filter(std::size_t i, const Pass& pass, TexelWalk& walk, std::vector<double>& weights,
              std::vector<std::vector<GroupValue>>& out, std::vector<Guide>& next) const {
    const auto own = [&](auto& table) { return std::span(table).subspan(i * groups_, groups_); };
    const std::span<const float> variances = own(variances_);
    if (std::all_of(variances.begin(), variances.end(), [](float v) { return v == 0; })) {
      for (std::size_t l = 0; l < layers_; ++l) out[l][i] = raw_[i * layers_ + l];
      for (std::size_t g = 0; g < groups_; ++g) next[i * groups_ + g] = {luminance(out[g][i].illuminance), 0};
      return;
    }
    const std::span<const TexelStep> steps = walk.around(i, pass.radius);
    weights.clear();
    for (const TexelStep& step : steps)
      weights.push_back(static_cast<double>(step.weight * likeness(i, step.node, pass.free)));
    centre(steps, weights);
    for (std::size_t l = 0; l < layers_; ++l) {
      const bool guide = l < groups_;
      double rgb[3] = {0, 0, 0}, error = 0, variance = 0;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        const std::size_t at = steps[k].node * layers_ + l;
        const double w = weights[k], e = static_cast<double>(raw_[at].error);
        rgb[0] += w * static_cast<double>(raw_[at].illuminance.r);
        rgb[1] += w * static_cast<double>(raw_[at].illuminance.g);
        rgb[2] += w * static_cast<double>(raw_[at].illuminance.b);
        error += w * w * e * e;
        if (guide) variance += w * w * static_cast<double>(variances_[steps[k].node * groups_ + l]);
      }
      GroupValue& value = out[l][i];
      value.illuminance =
          Rgb(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
      value.error = static_cast<float>(std::sqrt(error));
      if (guide) next[i * groups_ + l] = {luminance(value.illuminance), static_cast<float>(variance)};
    }
  }

  /// 1 where no group differs by more than noise, towards 0 where one does.
  float likeness(std::size_t i, std::size_t j, float free) const {
    if (i == j) return 1;
    float most = 0;
    for (std::size_t g = 0; g < groups_; ++g) {
      const Guide &a = guides_[i * groups_ + g], &b = guides_[j * groups_ + g];
      const float difference = a.value - b.value, squared = difference * difference;
      // A quotient of 0 by 0: both are exact and equal.
      if (squared > 0) most = std::max(most, squared / (a.variance + std::min(a.variance, b.variance)));
    }
    return std::exp(-kStrictness * std::max(0.0f, most - free - free_));
  }

  /// Makes the weights' sum 1 and moves their centroid to the texel's own place as far as no weight becomes
  /// negative: what changes linearly over the surface then stays (as with local linear regression).
  static void centre(std::span<const TexelStep> steps, std::vector<double>& weights) {
    double sum = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const double w = weights[k], u = static_cast<double>(steps[k].offset.x),
                   v = static_cast<double>(steps[k].offset.y);
      sum += w, x += w * u, y += w * v, xx += w * u * u, xy += w * u * v, yy += w * v * v;
    }
    x /= sum, y /= sum;
    xx = xx / sum - x * x, xy = xy / sum - x * y, yy = yy / sum - y * y;
    const double determinant = xx * yy - xy * xy;
    double slope_x = 0, slope_y = 0;
    if (determinant > 1e-6 * (xx + yy) * (xx + yy)) {
      slope_x = -(yy * x - xy * y) / determinant;
      slope_y = -(xx * y - xy * x) / determinant;
    }
    const auto tilt = [&](std::size_t k) {
      return slope_x * (static_cast<double>(steps[k].offset.x) - x) +
             slope_y * (static_cast<double>(steps[k].offset.y) - y);
    };
    double lowest = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) lowest = std::min(lowest, tilt(k));
    const double share = lowest < -1 ? -1 / lowest : 1;
    for (std::size_t k = 0; k < steps.size(); ++k)
      weights[k] = std::max(0.0, weights[k] / sum * (1 + share * tilt(k)));
  }

  const TexelGraph& graph_;
  std::size_t layers_, groups_;   ///< all; those that guide
  std::vector<GroupValue> raw_;   ///< [texel * layers + layer]; the other tables: [texel * groups + group]
  float free_ = 0;                ///< what the largest difference of all groups exceeds by chance
  std::vector<float> variances_;  ///< of the raw values' luminance, smoothed
  std::vector<Guide> guides_;
};

}  // namespace

std::vector<std::vector<GroupValue>> denoise(const TexelGraph& graph,
                                             std::span<const std::vector<GroupValue>> values,
                                             const Progress& progress, std::size_t guides) {
  return Filter(graph, values, std::min(guides, values.size())).run(progress);
}

}  // namespace sconce
