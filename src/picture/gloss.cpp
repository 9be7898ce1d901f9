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

/// Of the eye's side; interpolated and mapped normals may turn away from it.
Frame frame_at(const SurfacePoint& at, const Vec3& to_eye) {
  return Frame(glm::dot(at.shading_normal, to_eye) > 0 ? at.shading_normal : at.geometric_normal);
}

Vec3 to_local(const Frame& frame, const Vec3& v) {
  return {glm::dot(v, frame.x), glm::dot(v, frame.y), glm::dot(v, frame.z)};
}

float coat_of(const Shade& surface, float grazing) {
  return surface.roughness <= Material::kGlossy ? kDielectric + (1 - kDielectric) * grazing : 0;
}

/// @param cosine  between the eye and a facet
Rgb mirrored_by(const Shade& surface, float cosine) {
  const float grazing = schlick(cosine);
  const Rgb metal = surface.base_color + grazing * (Rgb(1) - surface.base_color);
  return (1 - surface.metallic) * Rgb(coat_of(surface, grazing)) + surface.metallic * metal;
}

/// Calls found(density per steradian, cosine between the eye and the facet) for the facets that mirror light
/// from a direction: D G1 / (4 cos) of visible normals, of what gloss() turns up from below, too.
template <class F>
void for_each_facet(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Vec3& direction,
                    float least_alpha, const F& found) {
  const float above = glm::dot(direction, at.geometric_normal);
  if (!(above > 0)) return;
  const Frame frame = frame_at(at, to_eye);
  const Vec3 eye = to_local(frame, to_eye);
  if (!(eye.z > 0)) return;
  const float alpha = std::max(surface.roughness * surface.roughness, least_alpha), alpha2 = alpha * alpha;
  const float masked = 2 * (eye.z + std::sqrt(alpha2 + (1 - alpha2) * eye.z * eye.z));
  for (const Vec3& from : {direction, direction - 2 * above * at.geometric_normal}) {
    const Vec3 facet = normalize_or(eye + to_local(frame, from), Vec3(0));
    if (!(facet.z > 0)) continue;
    const float wide = facet.x * facet.x + facet.y * facet.y + alpha2 * facet.z * facet.z;
    found(alpha2 / (kPi * wide * wide * masked), glm::dot(eye, facet));
  }
}

}  // namespace

bool mirrors(const Shade& surface) {
  return surface.metallic > 0 || surface.roughness <= Material::kGlossy;
}

Gloss gloss(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, Vec2 u) {
  const Frame frame = frame_at(at, to_eye);
  const Vec3 local = to_local(frame, to_eye);
  const Vec3 facet = frame.to_world(visible_normal(local, surface.roughness * surface.roughness, u));
  const float cosine = glm::dot(to_eye, facet);

  Gloss out;
  out.direction = glm::normalize(2 * cosine * facet - to_eye);
  const float below = glm::dot(out.direction, at.geometric_normal);
  if (below < 0) out.direction -= 2 * below * at.geometric_normal;
  out.diffuse = 1 - coat_of(surface, schlick(cosine));
  out.mirrored = mirrored_by(surface, cosine);
  return out;
}

Rgb gloss_of(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Vec3& direction,
             float least_alpha) {
  Rgb sum;
  for_each_facet(surface, to_eye, at, direction, least_alpha,
                 [&](float density, float cosine) { sum += density * mirrored_by(surface, cosine); });
  return sum;
}

float gloss_density(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Vec3& direction,
                    float least_alpha) {
  float sum = 0;
  for_each_facet(surface, to_eye, at, direction, least_alpha, [&](float density, float) { sum += density; });
  return sum;
}

}  // namespace sconce
