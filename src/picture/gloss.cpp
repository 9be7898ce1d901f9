// SPDX-License-Identifier: Apache-2.0
#include "picture/gloss.h"

#include <cmath>

namespace sconce {

namespace {

constexpr float kDielectric = 0.04f;  // reflectance at normal incidence, index 1.5

/// Schlick's share beyond the reflectance at normal incidence.
float schlick(float cosine) {
  const float c = 1 - std::clamp(cosine, 0.0f, 1.0f);
  return c * c * c * c * c;
}

/// Normal of a facet that the eye sees, about +z.
Vec3 visible_normal(const Vec3& to_eye, float alpha, Vec2 u) {
  const Vec3 stretched = glm::normalize(Vec3(alpha * to_eye.x, alpha * to_eye.y, to_eye.z));
  const float z = (1 - u.y) * (1 + stretched.z) - stretched.z;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.x;
  const Vec3 half = Vec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
  return normalize_or(Vec3(alpha * half.x, alpha * half.y, half.z), Vec3(0, 0, 1));
}

}  // namespace

bool mirrors(const Shade& surface) {
  return surface.metallic > 0 || surface.roughness <= Material::kGlossy;
}

Gloss gloss(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, Vec2 u) {
  // Interpolated and mapped normals may turn away from the eye.
  const bool seen = glm::dot(at.shading_normal, to_eye) > 0;
  const Frame frame(seen ? at.shading_normal : at.geometric_normal);
  const Vec3 local(glm::dot(to_eye, frame.x), glm::dot(to_eye, frame.y), glm::dot(to_eye, frame.z));
  const Vec3 facet = frame.to_world(visible_normal(local, surface.roughness * surface.roughness, u));
  const float cosine = glm::dot(to_eye, facet);

  Gloss out;
  out.direction = glm::normalize(2 * cosine * facet - to_eye);
  const float below = glm::dot(out.direction, at.geometric_normal);
  if (below < 0) out.direction -= 2 * below * at.geometric_normal;
  const float grazing = schlick(cosine);
  const float coat = surface.roughness <= Material::kGlossy ? kDielectric + (1 - kDielectric) * grazing : 0;
  out.diffuse = 1 - coat;
  const Rgb metal = surface.base_color + grazing * (Rgb(1) - surface.base_color);
  out.mirrored = (1 - surface.metallic) * Rgb(coat) + surface.metallic * metal;
  return out;
}

}  // namespace sconce
