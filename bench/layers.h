// SPDX-License-Identifier: Apache-2.0
// Layers and weights to measure with.
#pragma once

#include <cmath>

#include "core/parallel.h"
#include "mix/mixer.h"

/// Smooth light that differs by group.
inline sconce::Image make_layer(std::size_t group, int width, int height) {
  sconce::Image image = sconce::Image::rgb(width, height);
  sconce::parallel_for(static_cast<std::size_t>(height), 16, [&](std::size_t y) {
    for (int x = 0; x < width; ++x) {
      const float t =
          0.01f * (static_cast<float>(x) + 0.7f * static_cast<float>(y)) + static_cast<float>(group);
      image.set_rgb(x, static_cast<int>(y), sconce::Rgb(1.5f + std::sin(t), 1.2f, 0.8f + 0.5f * std::cos(t)));
    }
  });
  return image;
}

/// One page, white groups.
inline sconce::EncodedLayers make_layers(std::size_t groups, const sconce::EncodingChoice& encoding,
                                         int width, int height) {
  return sconce::encode_layers(std::vector(groups, encoding), 1, std::vector(groups, sconce::Rgb(1)),
                               [&](std::size_t group, int) { return make_layer(group, width, height); });
}

inline sconce::Mixer make_mixer(std::size_t groups, const sconce::Encoding& encoding, int side) {
  return sconce::Mixer(make_layers(groups, {&encoding, false}, side, side));
}

inline sconce::MixSpec make_weights(std::size_t groups, float shift) {
  sconce::MixSpec mix;
  for (std::size_t g = 0; g < groups; ++g)
    mix.weights.emplace_back(shift + static_cast<float>(g), 1.0f, 0.5f);
  return mix;
}
