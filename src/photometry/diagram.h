// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "photometry/drawing.h"
#include "photometry/photometry.h"

namespace sconce {

/// The polar diagram of data sheets: planes C0-C180 (solid) and C90-C270 (dashed), that of the peak (dotted)
/// where it lies elsewhere; cd, nadir down, the lower half where no light to be seen goes up.
/// @param title  what it is called where the file does not name it
Drawing polar_diagram(const Photometry& photometry, const std::string& title);

/// Lines of equal illuminance on a floor that faces the lamp: 1, 2, 5 times powers of ten, nine of
/// them from the brightest down, with their values on them; C0 to the right, C90 up. The lamp counts as a
/// point. Metres along the edges. @param height  of the lamp above the floor, m; the floor drawn is 4 heights
/// wide
Drawing isolux_diagram(const Photometry& photometry, const std::string& title, double height);

/// Name, maker and number of the luminaire above a drawing. @param middle  of its width
void add_title(Drawing& drawing, const Photometry& photometry, const std::string& title, double middle);

}  // namespace sconce
