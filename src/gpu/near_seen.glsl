// SPDX-License-Identifier: Apache-2.0
// A light field on what a picture shows, after gpu/seen_surfaces.glsl, gpu/near_light.glsl and gpu/gloss.glsl.

uniform vec3 near_shine;  // weight of what glossy surfaces mirror; black: they show none

// Radiance towards the eye, cd/m2, of this pass's terms: what is diffuse, and the lobe at each filter's centre, at least
// as wide as half a filter (eq. 13; twin of picture/glint.cpp).
vec3 near_seen(SconceSurface s) {
  NearPlace p = near_place(s.place, s.normal, s.face, s.bend);
  if (!p.below) return vec3(0.0);
  s.to_eye = s.to_eye * near_frame, s.mapped = s.mapped * near_frame, s.face = p.face;
  bool mirrors = near_shine != vec3(0.0) && sconce_mirrors(s), matt = s.there && near_color != vec3(0.0);
  float sum = 0.0;
  vec3 glints = vec3(0.0);
  for (int i = 0; i < near_count; ++i) {
    vec3 to = near_way(i, p);
    if (!(dot(to, p.face) > 0.0)) continue;
    float d = length(to), cosine = matt ? max(dot(to, p.normal) / d, 0.0) : 0.0;
    vec3 lobe = mirrors ? sconce_gloss(s, to / d, 0.5 * near_filter / d) : vec3(0.0);
    if (cosine == 0.0 && lobe == vec3(0.0)) continue;
    float lux = near_lux(i, p, to, 1.0);
    sum += lux * cosine, glints += lux * lobe;
  }
  // Metals that mirror nothing are as if matt.
  vec3 albedo = mirrors ? s.base * ((1.0 - s.metallic) * sconce_through(s)) : s.base;
  return near_color * albedo * 0.318309886 * sum + near_shine * glints;
}
