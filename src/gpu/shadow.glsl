// SPDX-License-Identifier: Apache-2.0
// A lamp's shadow maps, after gpu/shadow_filter.glsl.

uniform sampler2DArray sconce_shadow;
uniform int sconce_views;                              // 0 no shadows, 1 one map, 6 a cube: +x -x +y -y +z -z of the lamp
uniform bool sconce_parallel;
uniform vec3 sconce_eye;
uniform mat3 sconce_to_plane[6], sconce_from_plane[6];  // shadow_vertex.glsl, and back
uniform float sconce_near;

int sconce_view(vec3 d) {
  if (sconce_views < 6) return 0;
  vec3 local = d * lamp_frame, size = abs(local);
  if (size.x >= size.y && size.x >= size.z) return local.x > 0.0 ? 0 : 1;
  if (size.y >= size.z) return local.y > 0.0 ? 2 : 3;
  return local.z > 0.0 ? 4 : 5;
}

// Share of the lamp that a surface sees.
float sconce_visible(vec3 P, vec3 face, float bend) {
  if (sconce_views == 0) return 1.0;
  vec3 d = P - sconce_eye;
  int view = sconce_view(d);
  vec3 q = sconce_to_plane[view] * d;
  if (!sconce_parallel && q.z <= 0.0) return 0.0;
  vec2 at = sconce_parallel ? q.xy : q.xy / q.z;
  vec2 size = vec2(textureSize(sconce_shadow, 0).xy);
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, size))) return sconce_parallel ? 1.0 : 0.0;
  return sconce_filtered(sconce_shadow, view, at, q.z, d, sconce_from_plane[view], sconce_near, sconce_parallel, face, bend);
}
