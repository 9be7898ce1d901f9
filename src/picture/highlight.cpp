// SPDX-License-Identifier: Apache-2.0
#include "picture/highlight.h"

#include <algorithm>

#include "picture/gloss.h"
#include "picture/seen.h"

namespace sconce {

Highlights::Highlights(const Lamps& lamps, const MixSpec& mix, const Shade& surface, const Vec3& to_eye,
                       const SurfacePoint& at)
    : lamps_(&lamps), mix_(&mix), surface_(surface), to_eye_(to_eye), at_(at), chance_(lamps.size()) {
  lamps.importances(at.position, at.geometric_normal, chance_);
  float sum = 0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const Lamp& lamp = lamps.all()[i];
    const bool mesh = std::holds_alternative<MeshLamp>(lamp.shape);
    sum += chance_[i] *= mesh ? luminance(weight_of(mix, lamp.group) * lamp.flux) : 0;
  }
  if (!(sum > 0)) chance_.clear();
  for (float& chance : chance_) chance /= sum;
}

Rgb Highlights::pick(const Tracer& tracer, Vec2 u) const {
  if (chance_.empty()) return {};
  std::size_t lamp = 0;
  for (std::size_t i = 0; i < chance_.size(); ++i) {
    if (!(chance_[i] > 0)) continue;
    lamp = i;
    if (u.x < chance_[i]) break;
    u.x -= chance_[i];
  }
  u.x = std::min(u.x / chance_[lamp], 0x1.fffffep-1f);  // uniform again

  LightSample light;
  if (!lamps_->sample(lamp, at_.position, u, light)) return {};
  const Rgb mirrored = gloss_of(surface_, to_eye_, at_, light.direction, 0);
  if (mirrored.is_black()) return {};
  const float density = chance_[lamp] * light.pdf + gloss_density(surface_, to_eye_, at_, light.direction, 0);
  const Vec3 start = offset_origin(at_.position, at_.geometric_normal, at_.geometric_normal);
  const float end = shadow_end(light, glm::distance(start, at_.position));
  const Rgb passed = end > 0 ? tracer.transmittance({start, light.direction, end}) : Rgb(1.0f);
  return weight_of(*mix_, lamps_->all()[lamp].group) * mirrored * light.radiance * passed / density;
}

float Highlights::share(const Ray& ray, const Hit& hit) const {
  const int lamp = lamps_->lamp_of(hit.triangle);
  if (chance_.empty() || lamp < 0) return 1;
  const float picked = chance_[static_cast<std::size_t>(lamp)] *
                       lamps_->pdf(hit.triangle, hit.barycentric, hit.distance, ray.direction);
  const float met = gloss_density(surface_, to_eye_, at_, ray.direction, 0);
  return met > 0 ? met / (met + picked) : 1;
}

}  // namespace sconce
