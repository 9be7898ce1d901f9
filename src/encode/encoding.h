// SPDX-License-Identifier: Apache-2.0
// Texel encodings of a layer. Adding one is one .cpp (and its .glsl twin) and one row of table.cpp.
#pragma once

#include <span>
#include <string_view>

#include "image/image.h"
#include "image/io.h"

namespace sconce {

struct Encoding {
  std::string_view name, doc;
  double max_relative_error;   ///< half a step over the value, inside the range
  float smallest, largest;     ///< range in which that error holds
  bool is_signed;
  PixelType exr_type;          ///< float encodings are stored as OpenEXR of this type
};

/// f32, f16; in this order.
std::span<const Encoding> encodings();
/// @throws UsageError naming the choices
const Encoding& find_encoding(std::string_view name);

}  // namespace sconce
