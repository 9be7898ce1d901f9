// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"

namespace sconce {

inline constexpr double kKelvinMin = 1000, kKelvinMax = 11000;

/// Colour of a black body as linear Rec. 709 of luminance 1: Planck RGB(T) / Planck RGB(6504 K) per channel,
/// clamped at 0. 6504 K is white. Integrated over the CIE 1931 2-degree observer at 10 nm; chromaticities
/// agree with 1 nm tables to 1e-4.
/// @param kelvin  kKelvinMin..kKelvinMax
/// @throws UsageError outside of that
Rgb kelvin_color(double kelvin);

}  // namespace sconce
