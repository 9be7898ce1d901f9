// SPDX-License-Identifier: Apache-2.0
// A light field as gpu/lamp_points.glsl asks for it, after gpu/near_light.glsl.

// e: illuminance, lux, of this pass's terms; always a number.
bool sconce_arriving(vec3 P, vec3 N, vec3 face, float bend, out vec3 e) {
  NearPlace p = near_place(P, N, face, bend);
  float sum = 0.0;
  for (int i = 0; p.below && i < near_count; ++i) {
    vec3 to = near_way(i, p);
    float cosine = dot(to, p.normal);
    if (cosine > 0.0 && dot(to, p.face) > 0.0) sum += near_lux(i, p, to, cosine / length(to));
  }
  e = near_color * sum;
  return true;
}

void sconce_count(uint number) {}
