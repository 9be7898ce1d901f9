// SPDX-License-Identifier: Apache-2.0
#include "gpu/tiers.h"

#include "core/error.h"

namespace sconce::gpu {

EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier) {
  if (layers.textures.empty() || layers.pages() == 0) throw Error("OpenGL", "there are no layers to mix");
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    LayerTexture& texture = layers.textures[t];
    const EncodingChoice wanted = tier_encoding(tier, texture.encoding, texture.coefficient > 0);
    if (wanted == texture.encoding) continue;
    texture.encoding = wanted;
    texture.gain.clear();
    for (EncodedImage& image : layers.images[t]) {
      image = encode(decode(image), *wanted.encoding);
      texture.gain.push_back(image.gain);
    }
  }
  return layers;
}

const ShaderTier& tier_of(const Capabilities& can) {
  for (const ShaderTier& tier : shader_tiers())
    if ((can.float_linear || !tier.filter || !tier.f32) && (can.bc6h || !tier.bc6h)) return tier;
  return shader_tiers().back();
}

}  // namespace sconce::gpu
