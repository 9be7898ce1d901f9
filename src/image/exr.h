// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace sconce {

/// Does it begin as an OpenEXR file does?
inline bool is_exr(std::string_view bytes) {
  return bytes.starts_with("\x76\x2f\x31\x01");
}

/// read_exr() of bytes in memory. @throws Error, NotMyFormat
Image decode_exr(const std::string& bytes, const std::string& where);

}  // namespace sconce
