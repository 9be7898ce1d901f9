// SPDX-License-Identifier: Apache-2.0
// Texel encodings of a layer. Adding one is one .cpp (and its .glsl twin) and one row of table.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "image/image.h"
#include "image/io.h"

namespace sconce {

struct Encoding {
  std::string_view name, doc;
  double max_relative_error;  ///< half a step over the value, inside the range
  float smallest,
      largest;  ///< range in which that error holds; larger values are clamped, smaller ones lose precision
  bool is_signed;               ///< unsigned encodings clamp negative values to 0 and refuse signed bases
  PixelType exr_type;           ///< float encodings are stored as OpenEXR of this type
  std::size_t bytes_per_texel;  ///< of one R, G, B triple

  /// R, G, B triples -> texels, little-endian. NaN becomes 0.
  /// @pre rgb.size() % 3 == 0 and texels.size() == rgb.size() / 3 * bytes_per_texel
  void (*encode)(std::span<const float> rgb, std::span<std::byte> texels);
  /// @pre as for encode
  void (*decode)(std::span<const std::byte> texels, std::span<float> rgb);
};

/// f32, f16; in this order.
std::span<const Encoding> encodings();
/// @throws UsageError naming the choices
const Encoding& find_encoding(std::string_view name);

/// What a reader of the encoded layer will see: decode(encode(image)), channel names and attributes kept.
/// @throws Error when the channels do not come in threes
Image round_trip(const Image& image, const Encoding& encoding);

}  // namespace sconce
