// SPDX-License-Identifier: Apache-2.0
#include "encode/layer_texture.h"

#include <algorithm>

namespace sconce {

std::vector<std::string> LayerTexture::channels(const std::vector<std::string>& names) const {
  const std::string& name = names[groups.front()];
  if (!encoding.luminance) return {name + ".R", name + ".G", name + ".B"};
  std::vector<std::string> channels;
  for (const std::size_t g : groups) channels.push_back(names[g] + ".Y");
  return channels;
}

EncodedImage LayerTexture::encode(const std::vector<const Image*>& layers) const {
  const Image& first = *layers.front();
  if (!encoding.luminance) return sconce::encode(first, *encoding.encoding);
  Image packed(first.width, first.height, std::vector<std::string>(layers.size(), "Y"));
  for (std::size_t i = 0; i < layers.size(); ++i) pack_luminance(*layers[i], packed, i);
  return sconce::encode(packed, *encoding.encoding);
}

Image LayerTexture::decode(const EncodedImage& texture, std::size_t i, const Rgb& color) const {
  Image image = sconce::decode(texture);
  return encoding.luminance ? unpack_luminance(image, i, color) : image;
}

std::vector<LayerTexture> share_textures(const std::vector<EncodingChoice>& encodings) {
  std::vector<LayerTexture> textures;
  for (std::size_t g = 0; g < encodings.size(); ++g) {
    const auto open = std::find_if(textures.begin(), textures.end(), [&](const LayerTexture& t) {
      return encodings[g].luminance && t.encoding == encodings[g] && t.groups.size() < 4;
    });
    if (open != textures.end())
      open->groups.push_back(g);
    else
      textures.push_back({encodings[g], {g}, {}});
  }
  return textures;
}

}  // namespace sconce
