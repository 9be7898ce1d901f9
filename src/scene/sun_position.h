// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "core/vec.h"

namespace sconce {

/// Where the sun stands, degrees: above the horizon, and clockwise from north seen from above.
struct SunPosition {
  double elevation = 45, azimuth = 180;
};

/// Geometric position, without refraction. Within 0.02 degrees from 1950 to 2050.
/// @param seconds  since 1970-01-01 00:00 UTC
/// @param latitude, longitude  degrees, north and east positive
/// Source: J. Meeus, Astronomical Algorithms, 2nd ed., ch. 12, 13, 25 (low accuracy).
SunPosition sun_position(double seconds, double latitude, double longitude);

/// `2026-06-21T15:00:00+02:00`, seconds and zone optional; without a zone the time is that of the meridian
/// (15 degrees an hour). @return seconds since 1970 UTC, nothing where the text is no time
std::optional<double> parse_time(std::string_view text, double longitude);

/// Unit vector towards the sun in a world with y up and -z to the north.
/// @param north  degrees that north lies clockwise of -z, seen from above
Vec3 towards_sun(const SunPosition& sun, double north = 0);

}  // namespace sconce
