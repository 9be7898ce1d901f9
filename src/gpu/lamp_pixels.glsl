// SPDX-License-Identifier: Apache-2.0
// A lamp on what a picture shows, after gpu/seen_surfaces.glsl. Answers that are no number are painted over.

// Illuminance around a pixel: the mean of what its neighbours get, black where none has a number.
vec3 sconce_around(ivec2 at) {
  vec4 sum = vec4(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      SconceSurface s = sconce_surface(at + ivec2(x, y));
      vec3 e;
      if (s.there && sconce_arriving(s.place, s.normal, s.face, s.bend, e)) sum += vec4(e, 1.0);
    }
  return sum.rgb / max(sum.w, 1.0);
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  SconceSurface s = sconce_surface(at);
  if (!s.there) return;
  vec3 e;
  if (!sconce_arriving(s.place, s.normal, s.face, s.bend, e)) {
    sconce_count(uint(at.y * imageSize(sconce_seen).x + at.x));
    e = sconce_around(at);
  }
  sconce_add(at, s, e);
}
