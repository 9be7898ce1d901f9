// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "image/image.h"
#include "session/measure.h"
#include "tone/false_color.h"

namespace sconce {

/// A plane from its front in false colours, `along` upwards, with iso-lines where the scale has them, its
/// points' places, and the legend beside it.
/// @param lux  of every point, row by row; NaN = not measured, dark
Image8 plane_picture(const MeasuringPlane& plane, std::span<const float> lux, const FalseColor& scale);

}  // namespace sconce
