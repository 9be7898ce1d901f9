// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/receiver.h"

namespace sconce {

/// A rectangle of measuring points at the middles of its cells; they face `across` x `along`.
struct MeasuringPlane {
  Vec3 corner{0};
  Vec3 across{1, 0, 0}, along{0, 0, -1};  ///< edges, metres, at right angles
  int columns = 8, rows = 8;

  /// @throws UsageError for a plane without area, or without points
  void check() const;
  Vec3 normal() const { return glm::normalize(glm::cross(across, along)); }
  Vec3 point(int column, int row) const;
  std::vector<SurfacePoint> points() const;  ///< row by row
};

/// Horizontal, facing up, over all of the bounds but half a metre at each side (a tenth where that is less).
/// @param height  above the lowest floor, metres @param spacing  of points, metres, at most
MeasuringPlane horizontal_plane(const Bounds& bounds, float height, float spacing);

/// The height of `floor+0.75`, metres; nothing for other text.
std::optional<float> height_over_floor(std::string_view text);

/// A corner and two edges, with points at most so far apart. @throws UsageError: no right angle, no area
MeasuringPlane spanned_plane(const Vec3& corner, const Vec3& across, const Vec3& along, double spacing);

}  // namespace sconce
