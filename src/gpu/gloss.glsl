// SPDX-License-Identifier: Apache-2.0
// Twin of gloss_of() (picture/gloss.cpp): luminance towards the eye per lux of a surface that faces the light. After
// gpu/seen_surfaces.glsl.

const float kGlossy = 0.4, kDielectric = 0.04;  // Material::kGlossy; reflectance at normal incidence, index 1.5

bool sconce_mirrors(SconceSurface s) { return s.metallic > 0.0 || s.roughness <= kGlossy; }

vec3 sconce_mirrored_by(SconceSurface s, float cosine) {
  float c = 1.0 - clamp(cosine, 0.0, 1.0), grazing = c * c * c * c * c;
  float coat = s.roughness <= kGlossy ? kDielectric + (1.0 - kDielectric) * grazing : 0.0;
  return (1.0 - s.metallic) * vec3(coat) + s.metallic * mix(s.base, vec3(1.0), grazing);
}

// direction: unit, of the light; least_alpha: of the lobe's width
vec3 sconce_gloss(SconceSurface s, vec3 direction, float least_alpha) {
  float above = dot(direction, s.face);
  if (!(above > 0.0)) return vec3(0.0);
  vec3 up = dot(s.normal, s.to_eye) > 0.0 ? s.normal : s.face;
  float eye = dot(s.to_eye, up);
  if (!(eye > 0.0)) return vec3(0.0);
  float alpha = max(s.roughness * s.roughness, least_alpha), alpha2 = alpha * alpha;
  float masked = 2.0 * (eye + sqrt(alpha2 + (1.0 - alpha2) * eye * eye));
  vec3 sum = vec3(0.0);
  for (int turned = 0; turned < 2; ++turned) {
    vec3 between = s.to_eye + direction - float(turned) * 2.0 * above * s.face;
    vec3 facet = between == vec3(0.0) ? vec3(0.0) : normalize(between);
    float z = dot(facet, up);
    if (!(z > 0.0)) continue;
    vec3 along = facet - z * up;
    float wide = dot(along, along) + alpha2 * z * z;
    sum += sconce_mirrored_by(s, dot(s.to_eye, facet)) * (alpha2 / (3.14159265 * wide * wide * masked));
  }
  return sum;
}
