// SPDX-License-Identifier: Apache-2.0
// The package's geometry made ready to be looked at, by rays or on the GPU.
#pragma once

#include <array>

#include "package/package.h"
#include "scene/world.h"

namespace sconce {

/// Where one side of a triangle lies in the lightmap.
struct LightmapSide {
  int page = -1;             ///< -1 = no light is kept for this side
  std::array<Vec2, 3> uv{};  ///< [0,1], in the order of the World triangle's vertices

  Vec2 at(Vec2 barycentric) const {
    return (1 - barycentric.x - barycentric.y) * uv[0] + barycentric.x * uv[1] + barycentric.y * uv[2];
  }
};

/// Twins leave the scene and become the backs of the triangles they share.
struct ShownScene {
  /// @throws Error naming the damaged file
  explicit ShownScene(const Package& package);

  Scene scene;  ///< without twins: their lightmap coordinates are kept beside the triangles they share
  World world;
  std::vector<LightmapSide> front, back;  ///< per World triangle
};

}  // namespace sconce
