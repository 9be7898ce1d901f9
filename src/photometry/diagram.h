// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "photometry/drawing.h"
#include "photometry/photometry.h"

namespace sconce {

/// The polar diagram of data sheets: planes C0-C180 (solid) and C90-C270 (dashed), cd, nadir down.
Drawing polar_diagram(const Photometry& photometry, const std::string& title);

/// Lines of equal illuminance on a floor that faces the lamp: 1, 2, 5 times powers of ten, nine of
/// them from the brightest down; C0 to the right, C90 up. The lamp counts as a point.
/// @param height  of the lamp above the floor, m; the floor drawn is 4 heights wide
Drawing isolux_diagram(const Photometry& photometry, const std::string& title, double height);

}  // namespace sconce
