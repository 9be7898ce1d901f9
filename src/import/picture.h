// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "image/image.h"

namespace sconce {

/// An encoded picture as RGB or RGBA bytes: grey is spread over three channels. @throws Error, NotMyFormat
Image8 decode_texture(std::span<const unsigned char> file, const std::string& where);

/// "image/png" or "image/jpeg" by content, "" otherwise.
std::string picture_mime(std::span<const unsigned char> file);

}  // namespace sconce
