// SPDX-License-Identifier: Apache-2.0
#include "core/receiver.h"

namespace sconce {

Footprint Footprint::point(uint32_t id, ReceiverKind kind, const SurfacePoint& p) {
  FootprintPiece piece;
  piece.p0 = piece.p1 = piece.p2 = p.position;
  piece.n0 = piece.n1 = piece.n2 = p.shading_normal;
  piece.geometric_normal = p.geometric_normal;
  return {kind, id, {piece}, 0.0f};
}

SurfacePoint Footprint::sample(Vec2 u) const {
  std::size_t i = 0;
  while (i + 1 < pieces.size() && u.x >= pieces[i].cumulative) ++i;
  const FootprintPiece& piece = pieces[i];
  if (pieces.size() > 1) {
    const float before = i == 0 ? 0.0f : pieces[i - 1].cumulative;
    const float share = piece.cumulative - before;
    u.x = share > 0 ? std::min((u.x - before) / share, 0x1.fffffep-1f) : 0.0f;
  }
  const Vec2 b = square_to_triangle(u);
  const float b0 = 1.0f - b.x - b.y;
  SurfacePoint p;
  p.position = b0 * piece.p0 + b.x * piece.p1 + b.y * piece.p2;
  p.geometric_normal = piece.geometric_normal;
  p.shading_normal = normalize_or(b0 * piece.n0 + b.x * piece.n1 + b.y * piece.n2, piece.geometric_normal);
  return p;
}

}  // namespace sconce
