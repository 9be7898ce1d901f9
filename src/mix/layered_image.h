// SPDX-License-Identifier: Apache-2.0
// A rendered picture with one layer per light group (`<group>.R/G/B`, as other renderers write) mixes by the
// same settings as a package.
#pragma once

#include "mix/settings.h"

namespace sconce {

struct LayeredImage {
  Image image;                                       ///< all channels
  std::vector<GroupInfo> groups;                     ///< by name; neither lumens nor colours are known
  std::vector<std::array<std::size_t, 3>> channels;  ///< per group: red, green and blue
};

/// Every layer with R, G and B becomes a group, in the file's order; the picture's own R, G, B is none.
/// @throws Error naming `where` when there is no such layer
LayeredImage find_layers(Image image, const std::string& where);

/// sum_g w_g * layer_g, RGB, in the picture's own unit.
Image mix_layers(const LayeredImage& layered, const MixSpec& mix);

}  // namespace sconce
