// SPDX-License-Identifier: Apache-2.0
#include "session/final_gather.h"

#include "core/sobol.h"
#include "picture/seen.h"

namespace sconce {

namespace {

constexpr uint32_t kPaneStream = 0x70616e65u;

}  // namespace

Rgb final_gather(const View& view, const std::vector<Image>& pages, const SurfacePoint& at, uint32_t stream,
                 uint32_t first, uint32_t count) {
  const Vec3 start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  const Frame frame(at.shading_normal);
  Rgb sum;
  for (uint32_t r = first; r < first + count; ++r) {
    const Vec3 direction = frame.to_world(square_to_cosine(sobol_pair(r, 0, stream)));
    if (!(glm::dot(direction, at.geometric_normal) > 0)) continue;
    const auto [hit, passed] = view.tracer().follow(
        {start, direction}, [&] { return sobol_pair(r, 1, mix32(stream, kPaneStream)).x; });
    if (!hit) continue;
    const LightmapSide& side = view.side(hit.triangle, hit.back);
    if (side.page < 0) continue;
    const Shade surface = shade(view.scene(), view.world(), hit.triangle, hit.barycentric);
    sum += passed * surface.receiver_albedo() *
           bilinear(pages[static_cast<std::size_t>(side.page)], side.at(hit.barycentric));
  }
  return sum / static_cast<float>(count);
}

}  // namespace sconce
