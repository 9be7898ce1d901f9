// SPDX-License-Identifier: Apache-2.0
#include "mix/tier_layers.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "encode/half.h"

namespace sconce {

namespace {

bool exceeds_halves(const Image& image) {
  return std::any_of(image.data.begin(), image.data.end(),
                     [](float v) { return std::abs(v) > kLargestHalf; });
}

}  // namespace

EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier) {
  if (layers.textures.empty() || layers.pages() == 0) throw Error({}, "there are no layers to mix");
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    LayerTexture& texture = layers.textures[t];
    EncodingChoice wanted = tier_encoding(tier, texture.encoding, texture.coefficient > 0);
    if (wanted == texture.encoding) continue;
    std::vector<Image> pages;
    for (const EncodedImage& image : layers.images[t]) pages.push_back(decode(image));
    // The sun has 100,000 lux.
    if (wanted.encoding->type == TexelType::f16 && std::any_of(pages.begin(), pages.end(), exceeds_halves))
      wanted = tier_encoding(find_shader_tier("byte"), texture.encoding, texture.coefficient > 0);
    texture.encoding = wanted;
    texture.gain.clear();
    for (std::size_t page = 0; page < pages.size(); ++page) {
      layers.images[t][page] = encode(pages[page], *wanted.encoding);
      texture.gain.push_back(layers.images[t][page].gain);
    }
  }
  return layers;
}

}  // namespace sconce
