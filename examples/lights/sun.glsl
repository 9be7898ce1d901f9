// SPDX-License-Identifier: Apache-2.0
// Parallel light of lamp_intensity lux on a surface that faces it. Wants shadow=sun.

vec3 light(vec3 P, vec3 N) {
  return lamp_intensity * max(dot(N, -lamp_axis), 0.0);
}
