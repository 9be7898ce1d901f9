// SPDX-License-Identifier: Apache-2.0
// For tests of scenes that should be closed: rays that wander from surface to surface.
#pragma once

#include <span>

#include "core/sobol.h"
#include "trace/tracer.h"

namespace sconce::demo {

struct Strays {
  uint32_t shot = 0;
  uint32_t lost = 0;   ///< met nothing
  uint32_t backs = 0;  ///< ended on the back of what has only a front and is no lamp
};

/// Four diffuse reflections of each of `rays` rays, from the starts by turns, up and down.
inline Strays wander(const Scene& scene, const World& world, const Tracer& tracer,
                     std::span<const Vec3> starts, uint32_t rays) {
  Strays out;
  const auto n = static_cast<uint32_t>(starts.size());
  for (uint32_t i = 0; i < rays; ++i) {
    Vec3 origin = starts[i % n], normal(0, i % (2 * n) < n ? 1 : -1, 0);
    for (uint32_t bounce = 0; bounce < 4; ++bounce, ++out.shot) {
      const Vec2 u = sobol_pair(i, bounce, 1);
      const float phi = 2 * kPi * u.y, r = std::sqrt(u.x);
      const Vec3 direction =
          glm::normalize(Frame(normal).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x)}));
      const Hit hit = tracer.closest({offset_origin(origin, normal, direction), direction});
      out.lost += !hit;
      if (!hit) break;
      if (hit.back && !scene[world.materials[hit.triangle]].double_sided) {
        out.backs += scene[world.materials[hit.triangle]].emission.is_black();
        break;
      }
      normal = world.face_normals[hit.triangle] * (hit.back ? -1.0f : 1.0f);
      origin = world.position(hit.triangle, hit.barycentric);
    }
  }
  return out;
}

}  // namespace sconce::demo
