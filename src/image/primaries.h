// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "image/image.h"

namespace sconce {

using ColorMatrix = std::array<std::array<double, 3>, 3>;  ///< rows

ColorMatrix inverse(const ColorMatrix& m);
std::array<double, 3> transform(const ColorMatrix& m, const std::array<double, 3>& color);
/// Columns are the primaries' XYZ, scaled so that (1, 1, 1) is the white with Y = 1.
ColorMatrix rgb_to_xyz(const std::array<float, 8>& primaries);

/// Converts R, G, B from the image's own primaries and white to Rec. 709 (through CIE XYZ, no chromatic
/// adaptation) and forgets them. Images without R, G, B or without primaries stay as they are. Precision:
/// float, 1e-6 relative.
void to_rec709(Image& image);

/// R, G, B of an image for looking at and comparing: its own, else those of its only layer ("name.R" ...),
/// else its first or only channel three times (a depth, a luminance). Attributes are kept.
/// @throws Error when several layers stand side by side
Image rgb_part(const Image& image, const std::string& where);

}  // namespace sconce
