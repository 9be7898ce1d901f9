// SPDX-License-Identifier: Apache-2.0
// After a lamp's shader and gpu/shadow.glsl: its light with shadows, and a count of its answers that are no number.

layout(std430, binding = 7) buffer SconceMishaps { uint sconce_mishaps, sconce_first_mishap; };

// number: of the point or pixel, for messages
void sconce_count(uint number) {
  atomicAdd(sconce_mishaps, 1u);
  atomicMin(sconce_first_mishap, number);
}

// bend: between the interpolated normal and the face's. e: illuminance, lux. Returns false, and black, where the lamp's answer is no number.
bool sconce_arriving(vec3 P, vec3 N, vec3 face, float bend, out vec3 e) {
  e = light(P, N);
  // By bits: compilers may assume that there is no NaN.
  uvec3 exponent = (floatBitsToUint(e) >> 23u) & 255u;
  if (any(equal(exponent, uvec3(255u)))) {
    e = vec3(0.0);
    return false;
  }
  if (e == vec3(0.0)) return true;
  vec3 to = sconce_parallel ? -lamp_axis : lamp_position - P;
  e *= sconce_views > 0 && !(dot(to, face) > 0.0) ? 0.0 : sconce_visible(P, face, bend);
  return true;
}
