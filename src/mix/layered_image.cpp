// SPDX-License-Identifier: Apache-2.0
#include "mix/layered_image.h"

#include "core/error.h"
#include "mix/accumulate.h"

namespace sconce {

LayeredImage find_layers(Image image, const std::string& where) {
  LayeredImage layered;
  for (const std::string& channel : image.channels) {
    if (!channel.ends_with(".R")) continue;
    GroupInfo group;
    group.name = channel.substr(0, channel.size() - 2);
    group.color_spread = -1;
    const int green = image.channel(group.name + ".G"), blue = image.channel(group.name + ".B");
    if (green < 0 || blue < 0) continue;
    layered.channels.push_back({static_cast<std::size_t>(image.channel(channel)),
                                static_cast<std::size_t>(green), static_cast<std::size_t>(blue)});
    layered.groups.push_back(std::move(group));
  }
  if (layered.groups.empty())
    throw Error(where, "has no light-group layers", "channels GROUP.R, GROUP.G, GROUP.B");
  layered.image = std::move(image);
  return layered;
}

Image mix_layers(const LayeredImage& layered, const MixSpec& mix) {
  Image sum = Image::rgb(layered.image.width, layered.image.height);
  if (const auto unit = layered.image.text.find("sconce:unit"); unit != layered.image.text.end())
    sum.text.insert(*unit);
  for (std::size_t g = 0; g < layered.groups.size(); ++g)
    if (!mix.weights.at(g).is_black()) accumulate(sum, mix.weights[g], layered.image, layered.channels[g]);
  return sum;
}

}  // namespace sconce
