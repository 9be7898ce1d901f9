// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "photometry/photometry.h"

namespace sconce {

/// Fills a type C table (its polars are set) from the planes that a file lists, mirrored as LM-63 says by
/// where they begin and end: 0 to 0, 90, 180 or 360, or 90 to 270. A circle that ends within one and a half
/// steps before 360 is closed.
/// @param candela  [plane][polar]
/// @return false where they fit no such range; the table is then unchanged
bool fill_circle(Photometry& table, const std::vector<double>& planes, const std::vector<double>& candela);

/// Gives a type C table of planes within [0, 360] those at 0 and 360, interpolated between its last and
/// first.
void close_circle(Photometry& table);

}  // namespace sconce
