// SPDX-License-Identifier: Apache-2.0
// Twin of neutral.cpp.

vec3 tone_neutral(vec3 exposed, ToneParams p) {
  const float f90 = 0.04, start = 0.8 - f90, desaturation = 0.15;
  vec3 c = tone_clean(exposed);
  float x = min(c.r, min(c.g, c.b));
  vec3 d = c - (x <= 2.0 * f90 ? x - x * x / (4.0 * f90) : f90);
  float peak = max(d.r, max(d.g, d.b));
  if (peak <= start) return clamp(d, 0.0, 1.0);
  float new_peak = 1.0 - (1.0 - start) * (1.0 - start) / (peak + 1.0 - 2.0 * start);
  float g = 1.0 / (desaturation * (peak - new_peak) + 1.0);
  return clamp(d * (new_peak / peak * g) + new_peak * (1.0 - g), 0.0, 1.0);
}
