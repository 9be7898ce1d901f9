// SPDX-License-Identifier: Apache-2.0
// Twin of reinhard.cpp.

vec3 tone_reinhard(vec3 exposed, ToneParams p) {
  vec3 c = tone_clean(exposed);
  float l = dot(c, tone_rec709);
  float white = max(1.0, p.maximum);
  float x = min(l, white);
  return tone_by_luminance(c, l, x / (1.0 + x) * (1.0 + x / white / white));
}
