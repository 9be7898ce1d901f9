// SPDX-License-Identifier: Apache-2.0
#include "receive/atlas.h"

namespace sconce {

float TexelReceivers::importance(std::size_t i) const {
  const uint32_t side = sides_[first_[i]];
  const TexelTriangle& t = ((side & 1) != 0 ? atlas_->back : atlas_->front)[side / 2];
  const Vec2 a = t.uv[1] - t.uv[0], b = t.uv[2] - t.uv[0];
  const float texels = 0.5f * std::abs(a.x * b.y - a.y * b.x), area = world_->area(side / 2);
  return std::min(1.0f, texels / (area * atlas_->density * atlas_->density));
}

}  // namespace sconce
