// SPDX-License-Identifier: Apache-2.0
// The part of a surface that lies under a rectangle of texels.
#pragma once

#include <span>

#include "receive/atlas.h"

namespace sconce {

struct TexelRect {
  Vec2 lo, hi;  ///< texel coordinates
};

/// Appends what lies in the rectangle of each side (2 * triangle + 1 for the back) to `pieces`. Meanwhile
/// `cumulative` holds each piece's own area, m2; see finish().
void clip_to_rect(const World& world, const Atlas& atlas, std::span<const uint32_t> sides,
                  const TexelRect& rect, std::vector<FootprintPiece>& pieces);

/// Turns own areas into cumulative shares. Returns the area, m2.
float finish(std::vector<FootprintPiece>& pieces);

/// A whole side as one piece, for texels that have no part of measurable area.
FootprintPiece whole_side(const World& world, uint32_t side);

}  // namespace sconce
