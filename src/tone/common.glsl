// SPDX-License-Identifier: Apache-2.0
// Twins of tone/curve.h: what the curves share. Colours are exposed: 0.18 is middle grey.

struct ToneParams {
  float maximum, adaptation, drago_bias;
};

// Negative and NaN become 0, anything above 1e9 becomes 1e9.
float tone_clean(float v) {
  return v > 0.0 ? min(v, 1e9) : 0.0;
}

vec3 tone_clean(vec3 c) {
  return vec3(tone_clean(c.r), tone_clean(c.g), tone_clean(c.b));
}

// t = c * l_out / l_in, black stays black.
vec3 tone_by_luminance(vec3 c, float l_in, float l_out) {
  return l_in > 0.0 ? clamp(c * (l_out / l_in), 0.0, 1.0) : vec3(0.0);
}

// ln(1 + x) that keeps its precision near 0.
float tone_log1p(float x) {
  return x < 0.01 ? x * (1.0 - x * (0.5 - x * (1.0 / 3.0 - 0.25 * x))) : log(1.0 + x);
}

const vec3 tone_rec709 = vec3(0.2126, 0.7152, 0.0722);

// IEC 61966-2-1, the exact form, of a colour in [0,1].
vec3 linear_to_srgb(vec3 c) {
  return mix(1.055 * pow(max(c, vec3(1e-10)), vec3(1.0 / 2.4)) - 0.055, c * 12.92,
             vec3(lessThanEqual(c, vec3(0.0031308))));
}
