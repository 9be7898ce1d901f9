// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "image/image.h"

namespace sconce {

bool is_webp(std::span<const unsigned char> bytes);

/// RGB, or RGBA where the picture has alpha; the first frame. @throws Error
Image8 decode_webp(std::span<const unsigned char> bytes, const std::string& where);

}  // namespace sconce
