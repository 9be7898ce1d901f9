// SPDX-License-Identifier: Apache-2.0
#include "picture/glint.h"

#include "light/near_field.h"
#include "picture/gloss.h"

namespace sconce {

std::vector<std::size_t> near_lamps(const Lamps& lamps) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (std::holds_alternative<NearFieldLamp>(lamps.all()[i].shape)) out.push_back(i);
  return out;
}

Rgb glint(const Lamps& lamps, std::size_t lamp, const Tracer& tracer, const Shade& surface,
          const Vec3& to_eye, const SurfacePoint& at, Vec2 u) {
  LightSample light;
  if (!lamps.sample(lamp, at.position, u, light)) return {};
  const auto spacing =
      static_cast<float>(std::get<NearFieldLamp>(lamps.all()[lamp].shape).field->finest().field().spacing);
  const Rgb share = gloss_of(surface, to_eye, at, light.direction, 0.5f * spacing / light.distance);
  if (share.is_black()) return {};
  const Vec3 start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  return share * light.radiance * tracer.transmittance({start, light.direction, light.distance});
}

}  // namespace sconce
