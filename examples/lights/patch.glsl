// SPDX-License-Identifier: Apache-2.0
// A small matt patch that shines to one side, lamp_intensity candela along its normal: many of them are an area lamp.

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P;
  float d = max(length(to), 1e-6);
  return lamp_intensity * (max(dot(-to, lamp_axis), 0.0) * max(dot(N, to), 0.0) / (d * d * d * d));
}
