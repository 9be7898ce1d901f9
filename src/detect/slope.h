// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "core/rgb.h"

namespace sconce {

/// A line through what a face (y) and a white card in its place (x) do at several intensities, without light
/// to begin with: its slope is the reflectance. Codes round emission too, and so it is no fixed point.
class Slope {
 public:
  void add(const Rgb& x, const Rgb& y) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto u = static_cast<double>(channel(x, c)), v = static_cast<double>(channel(y, c));
      Sums& s = sums_[c];
      s.x += u, s.y += v, s.xx += u * u, s.xy += u * v;
    }
    ++count_;
    most_ = std::max(most_, std::min({x.r, x.g, x.b}));
  }
  /// The brightest card's darkest channel.
  float most() const { return most_; }
  Rgb value() const { return Rgb(of(sums_[0]), of(sums_[1]), of(sums_[2])); }

 private:
  struct Sums {
    double x = 0, y = 0, xx = 0, xy = 0;
  };
  static float channel(const Rgb& c, std::size_t i) { return i == 0 ? c.r : i == 1 ? c.g : c.b; }
  float of(const Sums& s) const {
    return static_cast<float>((count_ * s.xy - s.x * s.y) / (count_ * s.xx - s.x * s.x));
  }
  std::array<Sums, 3> sums_;
  double count_ = 0;
  float most_ = 0;
};

}  // namespace sconce
