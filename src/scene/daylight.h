// SPDX-License-Identifier: Apache-2.0
// Skies by formula, as pictures that SkyLight takes.
#pragma once

#include <span>
#include <string_view>

#include "core/vec.h"
#include "image/image.h"

namespace sconce {

/// What a sky depends on.
struct Daylight {
  Vec3 sun{0, 1, 0};     ///< towards it, unit, y up
  double turbidity = 3;  ///< of `preetham`: 2 very clear, 10 hazy
  double ground = 0.2;   ///< reflectance of what lies below the horizon, lit by the sky alone
};

/// One sky: its picture in cd/m2 and what it puts onto an unobstructed horizontal plane.
struct SkyKind {
  std::string_view name, doc;
  /// Luminance as colour, relative to any unit. @param direction  unit, y >= 0
  Rgb (*radiance)(const Daylight& daylight, const Vec3& direction);
  /// Horizontal illuminance in lux where none is asked for; 0 = radiance is in cd/m2 already.
  double (*illuminance)(const Daylight& daylight);
  bool needs_sun;
};
std::span<const SkyKind> sky_kinds();

/// A lat-long picture of the upper half and of the ground under it, cd/m2, scaled so that an unobstructed
/// horizontal plane gets `lux`. @param lux  0 = as the kind says
Image sky_picture(const SkyKind& kind, const Daylight& daylight, double lux = 0);

/// Illuminance in lux of the upper half of a sky's picture onto a horizontal plane; exact, since its pixels
/// are constant patches.
double horizontal_illuminance(const Image& sky);

/// Of the sun behind a clear atmosphere onto a plane that faces it, lux.
/// Source: IES Lighting Handbook, 9th ed., ch. 8 (extinction 0.21).
double clear_sun_illuminance(double elevation_degrees);

}  // namespace sconce
