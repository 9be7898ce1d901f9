// SPDX-License-Identifier: Apache-2.0
// Where paths add up the light that they bring, one form per basis. A path aims before it adds; flat sums do
// not listen, so that they cost nothing and keep their bits.
#pragma once

#include <span>

#include "core/vec.h"

namespace sconce {

/// E alone: values[3 * group + channel].
struct FlatSums {
  std::span<double> values;

  std::size_t width() const { return values.size(); }  ///< 3 * groups
  void aim(const Vec3& /*direction*/, float /*cosine*/) {}
  /// @param at  3 * group
  void add(std::size_t at, float r, float g, float b) const {
    values[at] += static_cast<double>(r);
    values[at + 1] += static_cast<double>(g);
    values[at + 2] += static_cast<double>(b);
  }
};

/// E and g: values[3 * (coefficient * groups + group) + channel]. What is added to E adds itself times
/// w / (2 cosine) to g: E = sum L cos, g = 1/2 sum L w.
class Sh1Sums {
 public:
  explicit Sh1Sums(std::span<double> values) : values_(values), width_(values.size() / 4) {}

  std::size_t width() const { return width_; }
  /// @param direction  unit, in which the light comes to the receiver
  /// @param cosine     with the shading normal, above 0
  void aim(const Vec3& direction, float cosine) { half_ = direction * (0.5f / cosine); }
  void add(std::size_t at, float r, float g, float b) const {
    FlatSums{values_}.add(at, r, g, b);
    for (int axis = 0; axis < 3; ++axis)
      FlatSums{values_}.add(at + width_ * static_cast<std::size_t>(axis + 1), r * half_[axis],
                            g * half_[axis], b * half_[axis]);
  }

 private:
  std::span<double> values_;
  std::size_t width_;
  Vec3 half_{0};
};

}  // namespace sconce
