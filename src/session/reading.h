// SPDX-License-Identifier: Apache-2.0
// What there is under the pointer.
#pragma once

#include <map>

#include "mix/encoded_layers.h"
#include "picture/render.h"

namespace sconce {

/// E_g of every group at a place of the lightmap, RGB lux at unit weight, bilinear as pictures look it up.
std::vector<Rgb> layers_at(const EncodedLayers& layers, int page, Vec2 uv);

/// Light that layers do not know, because something is not where it was baked: pages of each such group, as
/// weighted.
using GroupPages = std::map<std::size_t, std::vector<Image>>;

struct Reading {
  bool surface = false;  ///< else only the sky is there, and `luminance`
  Vec3 position{0}, normal{0};
  float distance = 0;  ///< metres from the eye
  std::string object, material;
  Rgb albedo;
  Rgb illuminance;               ///< lux
  float luminance = 0;           ///< cd/m2, with what shines by itself
  std::vector<float> group_lux;  ///< of each group, weighted; empty where no light is kept
};

/// @param at     in pixels from the top left
/// @param moved  in place of these groups' layers
Reading read_pixel(const View& view, const EncodedLayers& layers, const MixSpec& mix, const Camera& camera,
                   const PictureParams& params, Vec2 at, const GroupPages& moved = {});

}  // namespace sconce
