// SPDX-License-Identifier: Apache-2.0
// The same light on both sides of a chart's border, where the surface goes on smoothly beyond it.
#pragma once

#include "receive/atlas.h"

namespace sconce {

/// Texels that a bilinear look-up at a smooth seam meets, on both sides of it, and the four texels of the
/// other chart that hold the light of the same place. Hard edges have none, nor borders that something stands
/// on.
class Seams {
 public:
  Seams(const World& world, const Tracer& tracer, const Atlas& atlas);

  /// Makes both charts agree there: beyond the seam a texel takes the other chart's light, right before it
  /// the mean of its own and that, over and over. A fixed number of weighted means: linear, the same for
  /// every layer, and never beyond the values that are there; light that is linear in space stays as it is.
  /// In place, any channel count, gaps filled before.
  /// @param pages  all pages of a layer
  void close(std::vector<Image>& pages) const;

  std::size_t texels() const { return texels_.size(); }

 private:
  struct Texel {
    uint32_t at = 0;  ///< page * height * width + y * width + x
    float own = 0;    ///< share of its own light
    std::array<uint32_t, 4> from{};
    std::array<float, 4> share{};
  };
  std::vector<Texel> texels_;
};

}  // namespace sconce
