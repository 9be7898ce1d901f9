// SPDX-License-Identifier: Apache-2.0
// CIE 1931 2-degree observer: wavelengths to colours.
#pragma once

#include <array>

#include "core/rgb.h"

namespace sconce {

using Xyz = std::array<double, 3>;

/// Lumens of a watt of light whose luminosity is 1.
inline constexpr double kLumensPerWatt = 683;

/// Colour matching functions at a wavelength, nm: linear between the table's 10 nm, 0 outside of 380 to 770.
/// The second is the luminosity.
Xyz observer(double wavelength);

/// Linear Rec. 709 of tristimulus values; white is D65. Saturated colours have negative parts.
Xyz rec709_of(const Xyz& xyz);
/// And back.
Xyz xyz_of(const Rgb& rgb);

/// Rec. 709 of luminance 1; white where there is no luminance.
Rgb color_of(const Xyz& xyz);

}  // namespace sconce
