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

/// ACEScg: the primaries AP1 and the white of ACES, near D60.
inline constexpr std::array<float, 8> kAcescgPrimaries{0.713f, 0.293f, 0.165f,   0.830f,
                                                       0.128f, 0.044f, 0.32168f, 0.33767f};
/// Linear Rec. 709 to ACEScg, D65 adapted to ACES' white by Bradford's matrix.
ColorMatrix rec709_to_acescg();
/// Every R, G, B of an image in Rec. 709, those of layers ("name.R" ...), too, to ACEScg. float, 1e-6
/// relative.
void to_acescg(Image& image);

/// Converts R, G, B from the image's own primaries and white to Rec. 709 (ACEScg by the inverse of the above,
/// others through CIE XYZ without chromatic adaptation) and forgets them. Images without R, G, B or without
/// primaries stay as they are. Precision: float, 1e-6 relative.
void to_rec709(Image& image);

/// R, G, B of an image for looking at and comparing: its own, else those of its only layer ("name.R" ...),
/// else its first or only channel three times (a depth, a luminance). Attributes are kept.
/// @throws Error when several layers stand side by side
Image rgb_part(const Image& image, const std::string& where);

}  // namespace sconce
