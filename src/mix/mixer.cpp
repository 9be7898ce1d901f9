// SPDX-License-Identifier: Apache-2.0
#include "mix/mixer.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace sconce {

Mixer::Mixer(std::shared_ptr<const EncodedLayers> layers, std::size_t coefficient) : colors_(layers->colors) {
  for (std::size_t t = 0; t < layers->textures.size(); ++t) {
    const LayerTexture& texture = layers->textures[t];
    if (texture.coefficient != coefficient) continue;
    std::shared_ptr<const std::vector<EncodedImage>> pages(layers, &layers->images[t]);
    // Blocks are unpacked once; what they hold are halves.
    if (pages->front().encoding->type == TexelType::bc6h) {
      std::vector<EncodedImage> unpacked;
      for (const EncodedImage& page : *pages) unpacked.push_back(encode(decode(page), find_encoding("f16")));
      pages = std::make_shared<const std::vector<EncodedImage>>(std::move(unpacked));
    }
    const WeighTables tables(*pages->front().encoding);
    textures_.push_back({texture, tables, std::move(pages), std::vector<Rgb>(texture.groups.size())});
  }
  if (textures_.empty()) return;
  for (const EncodedImage& page : *textures_.front().pages) {
    sum_.push_back(Image::rgb(page.width, page.height));
    sum_.back().text["sconce:unit"] = "lux";
  }
}

std::size_t Mixer::bytes() const {
  std::size_t bytes = 0;
  for (const Texture& texture : textures_)
    for (const EncodedImage& page : *texture.pages) bytes += page.data.size();
  return bytes;
}

const std::vector<Image>& Mixer::mix(const MixSpec& mix) {
  if (mix.weights.size() != colors_.size())
    throw Error({}, "the mix has another number of groups than the package");
  std::vector<const Texture*> changed, lit;
  std::vector<std::vector<Rgb>> differences, weights;
  for (Texture& texture : textures_) {
    std::vector<Rgb> now, change;
    for (std::size_t i = 0; i < texture.layout.groups.size(); ++i) {
      const std::size_t g = texture.layout.groups[i];
      now.push_back(mix.weights[g] * colors_[g]);
      change.push_back(now.back() - texture.weights[i]);
    }
    const auto any = [](const std::vector<Rgb>& all) {
      return std::any_of(all.begin(), all.end(), [](const Rgb& w) { return !w.is_black(); });
    };
    if (any(change)) changed.push_back(&texture), differences.push_back(change);
    texture.weights = now;
    if (any(now)) lit.push_back(&texture), weights.push_back(std::move(now));
  }
  const bool whole = updates_ < 0 || updates_ >= kRefresh || changed.size() >= lit.size();
  updates_ = whole ? 0 : updates_ + 1;
  whole ? add(lit, weights, true) : add(changed, differences, false);
  return sum_;
}

void Mixer::add(const std::vector<const Texture*>& textures, const std::vector<std::vector<Rgb>>& weights,
                bool clear) {
  // Of a band: its sum stays in a core's own cache while textures stream by, each long enough to be foreseen.
  constexpr int kTexels = 32768;
  bytes_read_ = 0;
  for (const Texture* texture : textures)
    for (const EncodedImage& page : *texture->pages) bytes_read_ += page.data.size();
  for (std::size_t page = 0; page < sum_.size(); ++page) {
    Image& sum = sum_[page];
    std::vector<Weighted> terms;
    for (std::size_t i = 0; i < textures.size(); ++i)
      terms.push_back({textures[i]->tables, (*textures[i]->pages)[page], weights[i],
                       textures[i]->layout.encoding.luminance});
    const std::size_t row = 3 * static_cast<std::size_t>(sum.width);
    const int band_rows = std::max(1, kTexels / sum.width);
    parallel_for(static_cast<std::size_t>((sum.height + band_rows - 1) / band_rows), 1,
                 [&](std::size_t band) {
                   const int first = static_cast<int>(band) * band_rows,
                             rows = std::min(band_rows, sum.height - first);
                   float* to = &sum.data[static_cast<std::size_t>(first) * row];
                   if (clear) std::fill_n(to, row * static_cast<std::size_t>(rows), 0.0f);
                   add_weighted(terms, first, rows, to);
                 });
  }
}

}  // namespace sconce
