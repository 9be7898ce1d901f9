// SPDX-License-Identifier: Apache-2.0
#include "mix/encoded_layers.h"

#include <algorithm>

#include "core/parallel.h"
#include "mix/weigh.h"

namespace sconce {

namespace {

/// @param colors  of all groups
void keep_packed(EncodedLayers& layers, const std::vector<Rgb>& colors) {
  layers.colors.assign(colors.size(), Rgb(1));
  for (const LayerTexture& texture : layers.textures)
    if (texture.encoding.luminance)
      for (const std::size_t g : texture.groups) layers.colors[g] = colors[g];
}

}  // namespace

void EncodedLayers::layer(std::size_t group, std::vector<Image>& pages) const {
  constexpr int kBand = 32;  // rows, which stay in a core's own cache
  for (std::size_t t = 0; t < textures.size(); ++t) {
    const auto at = std::find(textures[t].groups.begin(), textures[t].groups.end(), group);
    if (at == textures[t].groups.end() || textures[t].coefficient != 0) continue;
    const WeighTables tables(*textures[t].encoding.encoding);
    if (tables.kind == WeighTables::Kind::none) {
      pages = layer(group);
      return;
    }
    std::vector<Rgb> weights(textures[t].groups.size());
    weights[static_cast<std::size_t>(at - textures[t].groups.begin())] = colors[group];
    pages.resize(images[t].size());
    for (std::size_t p = 0; p < pages.size(); ++p) {
      const EncodedImage& from = images[t][p];
      Image& to = pages[p];
      if (to.width != from.width || to.height != from.height) to = Image::rgb(from.width, from.height);
      parallel_for(static_cast<std::size_t>((from.height + kBand - 1) / kBand), 1, [&](std::size_t band) {
        const int first = static_cast<int>(band) * kBand, rows = std::min(kBand, from.height - first);
        std::fill_n(to.at(0, first), 3 * from.width * rows, 0.0f);
        const Weighted term{tables, from, weights, textures[t].encoding.luminance};
        add_weighted({&term, 1}, first, rows, to.at(0, first));
      });
    }
  }
}

std::size_t EncodedLayers::bytes() const {
  std::size_t sum = 0;
  for (const auto& pages : images)
    for (const EncodedImage& image : pages) sum += image.data.size();
  return sum;
}

std::vector<Image> EncodedLayers::layer(std::size_t group) const {
  std::vector<Image> pages;
  for (std::size_t t = 0; t < textures.size(); ++t)
    for (std::size_t i = 0; i < textures[t].groups.size(); ++i)
      if (textures[t].groups[i] == group && textures[t].coefficient == 0)
        for (const EncodedImage& page : images[t])
          pages.push_back(textures[t].decode(page, i, colors[group]));
  return pages;
}

EncodedLayers read_layers(const Package& package, std::size_t coefficients) {
  EncodedLayers layers;
  for (std::size_t c = 0; c < coefficients; ++c)
    for (LayerTexture& texture : package.textures(c)) layers.textures.push_back(std::move(texture));
  const auto pages = static_cast<std::size_t>(package.manifest().pages);
  layers.images.assign(layers.textures.size(), std::vector<EncodedImage>(pages));
  parallel_for(layers.textures.size() * pages, 1, [&](std::size_t i) {
    layers.images[i / pages][i % pages] =
        package.encoded(layers.textures[i / pages], static_cast<int>(i % pages));
  });
  std::vector<Rgb> colors;
  for (const GroupInfo& group : package.manifest().groups) colors.push_back(group.color);
  keep_packed(layers, colors);
  return layers;
}

EncodedLayers encode_layers(const std::vector<EncodingChoice>& choices, int pages,
                            const std::vector<Rgb>& colors,
                            const std::function<Image(std::size_t, int)>& layer) {
  EncodedLayers layers;
  layers.textures = share_textures(choices);
  for (LayerTexture& texture : layers.textures) {
    layers.images.emplace_back();
    for (int page = 0; page < pages; ++page) {
      std::vector<Image> images;
      std::vector<const Image*> pointers;
      for (const std::size_t g : texture.groups) images.push_back(layer(g, page));
      for (const Image& image : images) pointers.push_back(&image);
      layers.images.back().push_back(texture.encode(pointers));
      texture.gain.push_back(layers.images.back().back().gain);
    }
  }
  keep_packed(layers, colors);
  return layers;
}

}  // namespace sconce
