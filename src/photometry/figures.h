// SPDX-License-Identifier: Apache-2.0
// Figures that say what a luminaire is like.
#pragma once

#include <array>

#include "photometry/photometry.h"

namespace sconce {

struct Peak {
  double candela = 0, azimuth = 0, polar = 0;
};
/// The largest value of the table and where, degrees.
Peak peak_of(const Photometry& photometry);

/// Full angle within the plane through C and C + 180 between where intensity first falls to `fraction` of the
/// plane's peak on either side of it, degrees: 0.5 gives the beam, 0.1 the field angle. Type C.
double beam_angle(const Photometry& photometry, double c, double fraction);

/// Share of the flux below the horizon that falls directly onto the working plane of a square room of index k
/// = 0.60, 0.80, 1.00, 1.25, 1.50, 2.00, 2.50, 3.00, 4.00, 5.00 under evenly spread luminaires (EULUMDAT's
/// DR). Type C.
inline constexpr std::array<double, 10> kRoomIndices{0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5};
std::array<double, 10> direct_ratios(const Photometry& photometry);

}  // namespace sconce
