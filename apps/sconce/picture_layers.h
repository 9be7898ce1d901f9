// SPDX-License-Identifier: Apache-2.0
// One OpenEXR picture with layers side by side: light groups that sum to the beauty, and what surfaces are.
#pragma once

#include <string>

#include "stage.h"

namespace sconce::app {

struct LayerChoice {
  bool groups = false, albedo = false, normal = false, position = false, depth = false, id = false;

  bool surfaces() const { return albedo || normal || position || depth || id; }
};
/// `groups,albedo,normal,position,depth,id`: some of them. @throws UsageError
LayerChoice parse_layers(const std::string& text);

struct LayeredPicture {
  Image image;
  std::size_t light = 0;  ///< so many of its first channels are cd/m2
};

/// R, G, B (the beauty), then GROUP.R, GROUP.G, GROUP.B of every group, weighted as in the mix, and
/// `rest` for what shines without a group, where something does; then View::surfaces(). The beauty is the sum
/// of the groups where they are asked for: normal maps are seen in each group's own light. The text attribute
/// `sconce:groups` lists the groups' layers, one a line.
/// @param stage  of rays
LayeredPicture picture_layers(const Package& package, Stage& stage, const Camera& camera, const MixSpec& mix,
                              const PictureParams& params, const LayerChoice& choice,
                              const Progress& progress);

}  // namespace sconce::app
