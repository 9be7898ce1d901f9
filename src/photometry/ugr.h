// SPDX-License-Identifier: Apache-2.0
// Unified glare rating of a luminaire in the standard rooms: the table that European data sheets print.
#pragma once

#include <array>
#include <vector>

#include "photometry/photometry.h"

namespace sconce {

/// Area of the opening's outline seen along a unit direction of the luminaire's frame, m2.
double projected_area(const Opening& opening, const Vec3& direction);

struct UgrTable {
  struct Room {
    double x, y;  ///< across and along the line of sight, in heights of the lamps above the eye
  };
  static constexpr std::array<Room, 19> kRooms{{{2, 2},
                                                {2, 3},
                                                {2, 4},
                                                {2, 6},
                                                {2, 8},
                                                {2, 12},
                                                {4, 2},
                                                {4, 3},
                                                {4, 4},
                                                {4, 6},
                                                {4, 8},
                                                {4, 12},
                                                {8, 4},
                                                {8, 6},
                                                {8, 8},
                                                {8, 12},
                                                {12, 4},
                                                {12, 6},
                                                {12, 8}}};
  /// Ceiling, walls, working plane.
  static constexpr std::array<std::array<double, 3>, 5> kReflectances{
      {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}}};

  /// Per room: crosswise (the line of sight in plane C0) for the five reflectances, then endwise (in C90).
  std::array<std::array<double, 10>, 19> values{};
};

/// UGR = 8 log10(0.25 / Lb x sum L2 w / p2) (CIE 117) by the tabular method of CIE 190: lamps in the ceiling
/// a quarter of their height above the eye apart, the eye in the middle of the wall, Lb = indirect
/// illuminance of the walls / pi from three diffuse surfaces between eye and lamps, p = position_index().
/// @throws Error where the luminaire has no luminous area
UgrTable ugr_table(const Photometry& photometry);

}  // namespace sconce
