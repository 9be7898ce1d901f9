// SPDX-License-Identifier: Apache-2.0
// Twin of linear.cpp.

vec3 tone_linear(vec3 exposed, ToneParams p) {
  return clamp(tone_clean(exposed), 0.0, 1.0);
}
