// SPDX-License-Identifier: Apache-2.0
// After a lamp's shader and gpu/shadow.glsl: its light with shadows, and what was no number counted and left out.

layout(std430, binding = 7) buffer SconceMishaps { uint sconce_mishaps, sconce_first_mishap; };

// number: of the point, for messages
vec3 sconce_arriving(vec3 P, vec3 N, vec3 face, uint number) {
  vec3 e = light(P, N);
  // By bits: compilers may assume that there is no NaN.
  uvec3 exponent = (floatBitsToUint(e) >> 23u) & 255u;
  if (any(equal(exponent, uvec3(255u)))) {
    atomicAdd(sconce_mishaps, 1u);
    atomicMin(sconce_first_mishap, number);
    return vec3(0.0);
  }
  if (e == vec3(0.0)) return e;
  vec3 to = sconce_parallel ? -lamp_axis : lamp_position - P;
  if (sconce_views > 0 && !(dot(to, face) > 0.0)) return vec3(0.0);
  return e * sconce_visible(P, N, face);
}
