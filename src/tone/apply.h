// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/image.h"
#include "tone/exposure.h"

namespace sconce {

/// Exposure, curve and sRGB transfer of a whole picture, rounded to the nearest of 256 codes.
/// @param linear  first three channels R, G, B in cd/m2
Image8 tone_map(const Image& linear, const Exposure& exposure, const ToneMapper& mapper);

/// The same for one colour: display-coded sRGB in [0,1]. For swatches and tests.
Rgb tone_map(const Rgb& linear, const Exposure& exposure, const ToneMapper& mapper);

}  // namespace sconce
