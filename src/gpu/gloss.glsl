// SPDX-License-Identifier: Apache-2.0
// Twin of gloss_of() and gloss() (picture/gloss.cpp): luminance towards the eye per lux of a surface that faces the light. After
// gpu/seen_surfaces.glsl.

const float kGlossy = 0.4, kDielectric = 0.04;  // Material::kGlossy; reflectance at normal incidence, index 1.5

bool sconce_mirrors(SconceSurface s) { return s.metallic > 0.0 || s.roughness <= kGlossy; }

float sconce_grazing(float cosine) {
  float c = 1.0 - clamp(cosine, 0.0, 1.0);
  return c * c * c * c * c;
}

float sconce_coat(SconceSurface s, float grazing) {
  return s.roughness <= kGlossy ? kDielectric + (1.0 - kDielectric) * grazing : 0.0;
}

// What the coat lets through to what is diffuse: Gloss::diffuse in the mean over the facets that the eye sees (twin of
// visible_normal()). They lie alike on both sides of the eye's plane; steps of u.y are small where facets turn fast:
// within 1e-3 down to 6 degrees above the surface.
float sconce_through(SconceSurface s) {
  if (s.roughness > kGlossy) return 1.0;
  const int turns = 6, heights = 10;
  vec3 up = dot(s.mapped, s.to_eye) > 0.0 ? s.mapped : s.face;
  float z = clamp(dot(s.to_eye, up), 0.0, 1.0), alpha = s.roughness * s.roughness, sum = 0.0;
  vec3 eye = vec3(sqrt(1.0 - z * z), 0.0, z), wide = vec3(alpha * eye.x, 0.0, eye.z);
  wide = wide == vec3(0.0) ? vec3(0.0, 0.0, 1.0) : normalize(wide);
  for (int j = 0; j < heights; ++j) {
    float t = (float(j) + 0.5) / float(heights), v = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
    float height = (1.0 - v) * (1.0 + wide.z) - wide.z, r = sqrt(max(0.0, 1.0 - height * height));
    float weight = 30.0 * t * t * (1.0 - t) * (1.0 - t);
    for (int i = 0; i < turns; ++i) {
      float phi = 3.14159265 * (float(i) + 0.5) / float(turns);
      vec3 facet = vec3(r * cos(phi), r * sin(phi), height) + wide;
      facet.xy *= alpha;
      sum += weight * sconce_grazing(dot(eye, facet) / max(length(facet), 1e-20));
    }
  }
  return 1.0 - sconce_coat(s, sum / float(turns * heights));
}

vec3 sconce_mirrored_by(SconceSurface s, float cosine) {
  float grazing = sconce_grazing(cosine), coat = sconce_coat(s, grazing);
  return (1.0 - s.metallic) * vec3(coat) + s.metallic * mix(s.base, vec3(1.0), grazing);
}

// direction: unit, of the light; least_alpha: of the lobe's width
vec3 sconce_gloss(SconceSurface s, vec3 direction, float least_alpha) {
  float above = dot(direction, s.face);
  if (!(above > 0.0)) return vec3(0.0);
  vec3 up = dot(s.mapped, s.to_eye) > 0.0 ? s.mapped : s.face;
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
