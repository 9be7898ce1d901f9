// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "image/image.h"

namespace sconce {

/// 8- or 16-bit picture, decoded from sRGB to linear R, G, B; A, where stored, is taken as linear.
/// @throws NotMyFormat, Error
Image decode_linear(std::span<const unsigned char> bytes, const std::string& where);

}  // namespace sconce
