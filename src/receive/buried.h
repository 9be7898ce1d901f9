// SPDX-License-Identifier: Apache-2.0
// Texels that lie under or inside other geometry.
#pragma once

#include <span>

#include "receive/clip.h"

namespace sconce {

inline constexpr int kCells = 4;  ///< a texel is judged in 4 x 4 cells
inline constexpr uint16_t kAllCells = 0xffff;

TexelRect texel_rect(const Atlas& atlas, uint32_t texel);
TexelRect cell_rect(const TexelRect& texel, int cell);

/// Judges points of a surface by cosine-distributed rays. A point is buried where most of them end on a back
/// that no probe ray ever reached (the inside of a closed body, a black back in a crack), or right in front
/// of the point. A back that is reached is legal to see: the inside of a lampshade, the underside of a thin
/// table.
class BurialTest {
 public:
  BurialTest(const World& world, const Tracer& tracer, const Atlas& atlas)
      : world_(world), tracer_(tracer), atlas_(atlas) {}

  /// Whether a few rays from the texel meet nothing suspicious at all.
  bool clearly_free(uint32_t texel, std::span<const uint32_t> sides) const;

  /// The cells that hold surface and are not buried; kAllCells where none is buried.
  uint16_t free_cells(uint32_t texel, std::span<const uint32_t> sides) const;

 private:
  /// 0 = a ray into the open, 1 = a ray that tells of burial.
  float suspicion(const SurfacePoint& point, Vec2 u, float near) const;
  bool buried(const Footprint& part, float near, uint32_t stream, uint32_t rays) const;
  float texel_length(uint32_t side) const;

  const World& world_;
  const Tracer& tracer_;
  const Atlas& atlas_;
};

}  // namespace sconce
