// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace sconce {

/// Guth's position index of a lamp within the field of view, from 1 in the line of sight upwards: table 4.1
/// of CIE 117:1995, bilinear as the programs that print UGR tables take it.
/// @param lateral  |T| / R: offset to the side over the distance along the line of sight
/// @param height   H / R: height above the eye over the same
/// @return nothing where the table ends (T/R > 3, H/R > 1.9, and its empty corner): such a lamp does not
/// count
std::optional<double> position_index(double lateral, double height);

}  // namespace sconce
