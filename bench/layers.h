// SPDX-License-Identifier: Apache-2.0
// Layers and weights to measure with.
#pragma once

#include <cmath>

#include "mix/mixer.h"

/// Smooth light that differs by group.
inline sconce::EncodedImage make_layer(std::size_t group, const sconce::Encoding& encoding, int side) {
  sconce::Image image = sconce::Image::rgb(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      image.set_rgb(
          x, y, sconce::Rgb(1.5f + std::sin(0.01f * static_cast<float>(x + y) + static_cast<float>(group))));
  return encode(image, encoding);
}

/// One square page per group.
inline sconce::Mixer make_mixer(std::size_t groups, const sconce::Encoding& encoding, int side) {
  std::vector<sconce::LayerTexture> textures;
  std::vector<std::vector<sconce::EncodedImage>> pages;
  for (std::size_t g = 0; g < groups; ++g) {
    textures.push_back({{&encoding, false}, {g}, {}});
    pages.push_back({make_layer(g, encoding, side)});
  }
  return sconce::Mixer(std::move(textures), std::move(pages),
                       std::vector<sconce::Rgb>(groups, sconce::Rgb(1)));
}

inline sconce::MixSpec make_weights(std::size_t groups, float shift) {
  sconce::MixSpec mix;
  for (std::size_t g = 0; g < groups; ++g)
    mix.weights.emplace_back(shift + static_cast<float>(g), 1.0f, 0.5f);
  return mix;
}
