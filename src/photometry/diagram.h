// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "photometry/photometry.h"

namespace sconce {

/// The polar diagram of data sheets as SVG: planes C0-C180 (solid) and C90-C270 (dashed), cd, nadir down.
std::string polar_svg(const Photometry& photometry, const std::string& title);

/// Lines of equal illuminance on a floor that faces the lamp, as SVG: 1, 2, 5 times powers of ten, nine of
/// them from the brightest down; C0 to the right, C90 up. The lamp counts as a point.
/// @param height  of the lamp above the floor, m; the floor drawn is 4 heights wide
std::string isolux_svg(const Photometry& photometry, const std::string& title, double height);

/// Text that may stand between tags.
std::string escaped_xml(const std::string& text);

}  // namespace sconce
