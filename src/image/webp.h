// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "image/image.h"

namespace sconce {

bool is_webp(std::span<const unsigned char> bytes);

/// RGB, or RGBA where the picture has alpha; the first frame. @throws Error
Image8 decode_webp(std::span<const unsigned char> bytes, const std::string& where);

/// Without loss, colours under no opacity included; one channel or two become three or four. Nothing where a
/// side is above the format's 16383 pixels. @throws Error
std::vector<unsigned char> encode_webp(const Image8& image);

}  // namespace sconce
