// SPDX-License-Identifier: Apache-2.0
// A point lamp of lamp_intensity candela, as light/punctual.cpp has it.

uniform float range = 0.0;  // m, where its light ends (KHR_lights_punctual); 0: nowhere

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P;
  float d = max(length(to), 1e-6), q = d / range;
  float window = range > 0.0 ? clamp(1.0 - q * q * q * q, 0.0, 1.0) : 1.0;
  return lamp_intensity * (window * max(dot(N, to), 0.0) / (d * d * d));
}
