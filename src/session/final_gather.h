// SPDX-License-Identifier: Apache-2.0
// Light of lamps that rays do not know (light shaders) at points of space: direct light is told, reflected
// light is gathered from what they put onto the lightmap.
#pragma once

#include "picture/render.h"

namespace sconce {

/// Such a lamp, at unit weight.
struct KnownLamp {
  std::size_t group = 0;
  std::vector<Rgb> direct;   ///< per point, lux
  std::vector<Image> pages;  ///< all of its light on the lightmap, lux
};

/// Illuminance at a point by light that surfaces reflect, lux: a mean over cosine-distributed rays of albedo
/// x what the lightmap holds where they end ("final gather", Reichert 1992). The same bits for the same
/// stream and rays. Thread-safe.
/// @param first, count  of the stream's rays
Rgb final_gather(const View& view, const std::vector<Image>& pages, const SurfacePoint& at, uint32_t stream,
                 uint32_t first, uint32_t count);

}  // namespace sconce
