// SPDX-License-Identifier: Apache-2.0
// Twin of lut.cpp, after the constants that tone_lut_glsl() writes.

uniform sampler2D tone_lut;

// Interpolated here: filters of graphics hardware have 8 bits of fraction, if they take floats at all.
float tone_look_up(float v) {
  int last = textureSize(tone_lut, 0).x - 1;
  float at = clamp((log2(max(v, 1e-30)) - tone_low) / (tone_high - tone_low), 0.0, 1.0) * float(last);
  int i = min(int(at), last - 1);
  return mix(texelFetch(tone_lut, ivec2(i, 0), 0).r, texelFetch(tone_lut, ivec2(i + 1, 0), 0).r, at - float(i));
}

vec3 tone_finish(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return tone_power == 1.0 ? c : pow(c, vec3(tone_power));
}

vec3 tone_lut_luminance(vec3 exposed) {
  vec3 c = tone_clean(exposed);
  float l = dot(c, tone_weights);
  return l > 0.0 ? tone_finish(c * (tone_look_up(l) * min(1.0, exp2(tone_high) / l))) : vec3(0.0);
}

vec3 tone_lut_channels(vec3 exposed) {
  vec3 v = tone_clean(exposed) * tone_before;
  return tone_finish(vec3(tone_look_up(v.r), tone_look_up(v.g), tone_look_up(v.b)) * tone_after);
}
