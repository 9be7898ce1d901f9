// SPDX-License-Identifier: Apache-2.0
// A spot of lamp_intensity candela along its axis, as light/punctual.cpp has it: the edge of the cone is the square of
// a ramp that is linear in the cosine.

uniform float inner = 0.0, outer = 45.0;  // half angles of the full cone and of its end, degrees
uniform float range = 0.0;                // m, where its light ends (KHR_lights_punctual); 0: nowhere

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P;
  float d = max(length(to), 1e-6), q = d / range;
  float window = range > 0.0 ? clamp(1.0 - q * q * q * q, 0.0, 1.0) : 1.0;
  float end = cos(radians(outer)), ramp = max(0.001, cos(radians(inner)) - end);
  float cone = clamp((dot(-to, lamp_axis) / d - end) / ramp, 0.0, 1.0);
  return lamp_intensity * (window * cone * cone * max(dot(N, to), 0.0) / (d * d * d));
}
