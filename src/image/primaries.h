// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/image.h"

namespace sconce {

/// Converts R, G, B from the image's own primaries and white to Rec. 709 (through CIE XYZ, no chromatic
/// adaptation) and forgets them. Images without R, G, B or without primaries stay as they are. Precision:
/// float, 1e-6 relative.
void to_rec709(Image& image);

/// R, G, B of an image for looking at and comparing: its own, else those of its only layer ("name.R" ...),
/// else its first or only channel three times (a depth, a luminance). Attributes are kept.
/// @throws Error when several layers stand side by side
Image rgb_part(const Image& image, const std::string& where);

}  // namespace sconce
