// SPDX-License-Identifier: Apache-2.0
// A rendered picture with one layer per light group, as other renderers write them, mixes by the same
// settings as a package.
#pragma once

#include <optional>

#include "image/exr_parts.h"
#include "mix/group_names.h"
#include "mix/settings.h"

namespace sconce {

struct LayeredImage {
  using Rgbs = std::array<std::size_t, 3>;  ///< channels of red, green and blue

  ExrParts picture;
  std::string renderer;  ///< whose names these are; "" where plain layers were taken
  std::vector<GroupInfo>
      groups;  ///< by name; neither lumens nor colours are known. With a beauty the last is `rest`
  std::vector<std::string> layers;   ///< per group but `rest`
  std::vector<Rgbs> channels;        ///< per group but `rest`
  std::optional<Rgbs> beauty;        ///< the picture of all lights
  std::optional<std::size_t> alpha;  ///< of the beauty
  std::vector<std::size_t> others;   ///< channels that belong to no light
};

/// Layers become groups by the names that renderers give, or by an expression of the user's. Where no name
/// tells and all layers are colours, each is a group. What the beauty has and no group is the group `rest`.
/// @param expression  see find_groups()
/// @throws Error naming `where` when there is no such layer; UsageError for a bad expression
LayeredImage find_layers(ExrParts picture, const std::string& where, const std::string& expression = {});

/// How much of the beauty is in no group.
struct Rest {
  double share = 0;     ///< of the luminance
  double negative = 0;  ///< share of pixels where it is below 0 by more than halves round
};
Rest measure_rest(const LayeredImage& layered);

/// sum_g w_g * layer_g, RGB, in the picture's own unit. With a beauty B: w_rest B + sum_g (w_g - w_rest)
/// layer_g, which is the same and returns B's bits where all weights are 1.
Image mix_layers(const LayeredImage& layered, const MixSpec& mix);

/// The picture with R, G, B (and A) mixed, its other channels, windows and attributes kept, without the
/// groups.
/// @param mixed  of mix_layers()
ExrParts with_mixed(const LayeredImage& layered, const Image& mixed);

/// R, G, B over the display window, black where there is no pixel, in Rec. 709.
Image shown(const LayeredImage& layered, const Image& mixed);

}  // namespace sconce
