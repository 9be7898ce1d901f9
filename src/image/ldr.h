// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "image/image.h"

namespace sconce {

/// 8- or 16-bit picture, decoded from sRGB to linear R, G, B; A, where stored, is taken as linear.
/// @throws NotMyFormat, Error
Image decode_linear(std::span<const unsigned char> bytes, const std::string& where);

/// Radiance RGBE: mantissa / 256 * 2^(e - 128), without the half step that Radiance's own reader adds (0.2 %
/// darker in the mean); EXPOSURE lines are ignored. @throws NotMyFormat, Error
Image decode_hdr(std::span<const unsigned char> bytes, const std::string& where);

}  // namespace sconce
