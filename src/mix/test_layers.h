// SPDX-License-Identifier: Apache-2.0
// For tests only: the mix of encoded layers, texel by texel, of one coefficient of the basis.
#pragma once

#include "mix/encoded_layers.h"

namespace sconce {

inline std::vector<Image> plain_mix(const EncodedLayers& layers, const std::vector<Rgb>& weights,
                                    std::size_t coefficient = 0) {
  std::vector<Image> pages(static_cast<std::size_t>(layers.pages()),
                           Image::rgb(layers.width(), layers.height()));
  for (std::size_t t = 0; t < layers.textures.size(); ++t)
    for (std::size_t i = 0; i < layers.textures[t].groups.size(); ++i) {
      if (layers.textures[t].coefficient != coefficient) continue;
      const std::size_t g = layers.textures[t].groups[i];
      for (std::size_t page = 0; page < pages.size(); ++page) {
        const Image decoded = layers.textures[t].decode(layers.images[t][page], i, layers.colors[g]);
        for (int y = 0; y < layers.height(); ++y)
          for (int x = 0; x < layers.width(); ++x)
            pages[page].set_rgb(x, y, pages[page].rgb_at(x, y) + weights[g] * decoded.rgb_at(x, y));
      }
    }
  return pages;
}

}  // namespace sconce
