// SPDX-License-Identifier: Apache-2.0
// Texel encodings of a layer. Adding one is one .cpp with its .glsl twin and one row of table.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace sconce {

/// What stored texels are made of, as graphics libraries name it.
enum class TexelType : uint8_t { f32, f16, u8, bc6h };

struct Encoding;

/// An image as it is stored and as a GPU takes it.
struct EncodedImage {
  const Encoding* encoding = nullptr;
  int width = 0, height = 0;
  int channels = 3;                       ///< of the image before encoding
  std::array<float, 4> gain{1, 1, 1, 1};  ///< per channel: encoded is gain * value
  std::vector<std::byte> data;            ///< little-endian; planes one after the other, row 0 first
};

struct Encoding {
  std::string_view name, doc;
  double max_relative_error;  ///< inside the range; of the texel's (bc6h: block's) largest channel where
                              ///< channels share bits, else of each channel
  float smallest, largest;    ///< range at gain 1; larger values are clamped, smaller ones lose precision
  bool is_signed;             ///< unsigned encodings clamp negative values to 0 and refuse signed bases
  bool per_channel;           ///< every channel alone, so that four groups' luminances may share a texture
  bool filters;               ///< texture units may interpolate: floats, or blocks that they decode
  bool has_gain;              ///< gain = largest / the image's largest value, per channel or for all together
  TexelType type;
  int stored_channels;    ///< of a texture; 0 = those of the image
  int planes;             ///< textures of this type
  std::string_view glsl;  ///< defines vec4 decode_NAME(vec4 texel of each plane..., vec4 gain)

  /// @param out  sizes, gain and room for the data are set. NaN becomes 0.
  void (*encode)(const Image& image, EncodedImage& out);
  /// Rows [first, first + rows) as floats, image.channels interleaved. Blocks: `first` is a multiple of 4.
  void (*decode)(const EncodedImage& in, int first, int rows, float* out);

  std::size_t channels_of(int image_channels) const {
    return static_cast<std::size_t>(stored_channels == 0 ? image_channels : stored_channels);
  }
  /// Of one plane.
  std::size_t plane_bytes(int width, int height, int image_channels) const;
};

/// f32, f16, exp8, rgbe8, srgbe8, multi8, bc6h; in this order.
std::span<const Encoding> encodings();
/// @throws UsageError naming the choices
const Encoding& find_encoding(std::string_view name);

/// 3 channels, or 1 to 4 where the encoding is per channel. @throws Error for other images
EncodedImage encode(const Image& image, const Encoding& encoding);
/// Channels "R", "G", "B"; or "Y0", "Y1", ... where there are not three.
Image decode(const EncodedImage& encoded);

/// Ratio of the largest to the smallest value between which an encoding's relative error (of single channels)
/// stays below `error`: its useful dynamic range. 1 where there is none.
double range_within(const Encoding& encoding, double error);

}  // namespace sconce
