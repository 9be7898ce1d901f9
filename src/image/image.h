// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/rgb.h"

namespace sconce {

/// CIE xy of red, green, blue and white: Rec. 709 with D65.
inline constexpr std::array<float, 8> kRec709Primaries{0.64f, 0.33f, 0.30f,   0.60f,
                                                       0.15f, 0.06f, 0.3127f, 0.3290f};

/// Float image with named channels, interleaved; row 0 is the first row of the file (top of a picture, v = 0
/// of a lightmap).
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;                  ///< e.g. {"R","G","B"} or {"ceiling.R", ...}
  std::vector<float> data;                            ///< width * height * channels.size()
  std::map<std::string, std::string> text;            ///< string attributes, e.g. "sconce:unit" = "lux"
  std::map<std::string, float> number;                ///< float attributes, e.g. "whiteLuminance"
  std::array<float, 8> primaries = kRec709Primaries;  ///< what R, G, B mean; only read_exr sets others

  Image() = default;
  Image(int width_, int height_, std::vector<std::string> channels_)
      : width(width_),
        height(height_),
        channels(std::move(channels_)),
        data(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * channels.size(), 0.0f) {}
  static Image rgb(int width, int height) { return Image(width, height, {"R", "G", "B"}); }

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t stride() const { return channels.size(); }
  float* at(int x, int y) {
    return &data[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)) *
                 stride()];
  }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  Rgb rgb_at(int x, int y) const { return {at(x, y)[0], at(x, y)[1], at(x, y)[2]}; }
  void set_rgb(int x, int y, const Rgb& c) { at(x, y)[0] = c.r, at(x, y)[1] = c.g, at(x, y)[2] = c.b; }
  /// Index of the channel, or -1.
  int channel(std::string_view name) const;
};

/// The RGB channels of a picture, whatever else it holds; grey ones thrice.
Image rgb_of(const Image& image);

/// 8-bit image, 1 to 4 interleaved channels, row 0 on top.
struct Image8 {
  int width = 0, height = 0, channels = 3;
  std::vector<unsigned char> data;
};

}  // namespace sconce
