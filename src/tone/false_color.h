// SPDX-License-Identifier: Apache-2.0
// Quantities as colours with a legend: lux, cd/m2, percent.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace sconce {

/// A scale of colours from dark blue over green and yellow to red, linear or by decades.
struct FalseColor {
  float low = 0, high = 1000;  ///< at the scale's ends; what lies beyond has their colours
  bool decades = false;        ///< even steps are even ratios; needs low > 0
  bool lines = false;          ///< iso-lines where the legend's ticks are

  /// @throws UsageError where the scale has no length, or decades would begin at 0
  void check() const;
  /// @return place on the scale, [0,1]; NaN and negative values lie at its beginning
  float place(float value) const;
  bool operator==(const FalseColor&) const = default;
};

/// At most 16 round values within the scale, ascending: 1, 2, 5 of each decade, or even steps.
std::vector<float> legend_ticks(const FalseColor& scale);
/// "2,000", "0.05": a tick as the legend shows it.
std::string tick_text(float value);

/// Display codes in [0,1]. @param place  on the scale
Rgb false_color(float place);

/// A whole picture. @param values  of one channel, or of R, G and B, whose luminance counts
Image8 false_color(const Image& values, const FalseColor& scale);

/// The twin (GLSL 4.50): vec3 false_color(float place). How lines are found is the caller's.
std::string false_color_glsl();

}  // namespace sconce
