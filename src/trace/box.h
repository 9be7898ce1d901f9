// SPDX-License-Identifier: Apache-2.0
// Where rays meet boxes.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "trace/tracer.h"

namespace sconce {

/// Where a ray enters a box, m; nothing where it does not.
inline std::optional<float> entry(const Bounds& box, const Ray& ray) {
  float near = 0, far = ray.far;
  for (int k = 0; k < 3; ++k) {
    const float a = (box.lo[k] - ray.origin[k]) / ray.direction[k],
                b = (box.hi[k] - ray.origin[k]) / ray.direction[k];
    // Along a plane of the box a or b is nan: then the ray counts as within.
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near > far ? std::nullopt : std::optional(near);
}

inline bool meets(std::span<const Bounds> boxes, const Ray& ray) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Bounds& box) { return entry(box, ray); });
}

}  // namespace sconce
