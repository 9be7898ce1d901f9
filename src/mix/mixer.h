// SPDX-License-Identifier: Apache-2.0
// The software path: a package's layers in memory as they are stored, and their weighted sum, kept up to date
// while faders move.
#pragma once

#include <memory>
#include <vector>

#include "mix/encoded_layers.h"
#include "mix/settings.h"
#include "mix/weigh.h"

namespace sconce {

class Mixer {
 public:
  /// Reads all layers. @throws as Package::encoded
  explicit Mixer(const Package& package) : Mixer(read_layers(package)) {}
  explicit Mixer(EncodedLayers layers) : Mixer(std::make_shared<const EncodedLayers>(std::move(layers))) {}
  /// Shares what is stored in memory with others.
  /// @param coefficient  of the basis
  explicit Mixer(std::shared_ptr<const EncodedLayers> layers, std::size_t coefficient = 0);

  /// sum_g w_g * E_g per page, RGB lux. Where less than half of the textures have other weights than at the
  /// last call, only they are read and their differences added; every kRefresh such calls all is summed anew,
  /// so that rounding does not add up. Same bits at any number of threads for the same calls.
  const std::vector<Image>& mix(const MixSpec& mix);

  /// Bytes of codes that the last call read.
  std::size_t bytes_read() const { return bytes_read_; }
  std::size_t bytes() const;

  static constexpr int kRefresh = 256;

 private:
  struct Texture {
    LayerTexture layout;
    WeighTables tables;
    std::shared_ptr<const std::vector<EncodedImage>> pages;
    std::vector<Rgb> weights;  ///< of the last call; colours multiplied in
  };
  /// Adds textures[i] with weights[i] to every page.
  void add(const std::vector<const Texture*>& textures, const std::vector<std::vector<Rgb>>& weights,
           bool clear);

  std::vector<Texture> textures_;
  std::vector<Rgb> colors_;  ///< EncodedLayers::colors
  std::vector<Image> sum_;
  int updates_ = -1;  ///< since all was summed; -1: never
  std::size_t bytes_read_ = 0;
};

}  // namespace sconce
