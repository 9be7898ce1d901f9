// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "image/image.h"

namespace sconce {

/// Radiance picture (RGBE or XYZE, flat or either run-length coding, any of the eight orientations) as R, G,
/// B, row 0 on top. Mantissas get the half step that Radiance adds; values are divided by the product of
/// EXPOSURE lines and, channel by channel, of COLORCORR lines, so they are in the picture's own radiance
/// unit. PRIMARIES are kept for to_rec709(); XYZE is converted at once. Error: 0.39 % of the largest
/// component, the format's own.
/// @throws NotMyFormat, Error (damaged, cut short)
Image decode_hdr(std::span<const unsigned char> bytes, const std::string& where);

}  // namespace sconce
