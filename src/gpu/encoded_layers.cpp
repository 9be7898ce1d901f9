// SPDX-License-Identifier: Apache-2.0
#include "gpu/encoded_layers.h"

#include "core/error.h"

namespace sconce::gpu {

std::size_t EncodedLayers::bytes() const {
  std::size_t sum = 0;
  for (const auto& pages : images)
    for (const EncodedImage& image : pages) sum += image.data.size();
  return sum;
}

EncodedLayers read_layers(const Package& package) {
  EncodedLayers layers;
  const Manifest& m = package.manifest();
  layers.textures = package.textures();
  if (layers.textures.empty() || m.pages == 0) throw Error(package.path().string(), "has no layers to mix");
  layers.colors.assign(m.groups.size(), Rgb(1));
  for (const LayerTexture& texture : layers.textures) {
    layers.images.emplace_back();
    for (int page = 0; page < m.pages; ++page) layers.images.back().push_back(package.encoded(texture, page));
    if (texture.encoding.luminance)
      for (const std::size_t g : texture.groups) layers.colors[g] = m.groups[g].color;
  }
  return layers;
}

EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier) {
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    LayerTexture& texture = layers.textures[t];
    const EncodingChoice wanted = tier_encoding(tier, texture.encoding);
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
