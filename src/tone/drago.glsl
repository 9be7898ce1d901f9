// SPDX-License-Identifier: Apache-2.0
// Twin of drago.cpp.

// Relative luminances; -> [0,1] up to the maximum.
float drago_luminance(float x, float maximum, float bias) {
  float power = log(bias) / log(0.5);
  return tone_log1p(x) * log(10.0) / (tone_log1p(maximum) * log(2.0 + 8.0 * pow(x / maximum, power)));
}

float drago_smallest_bias(float maximum) {
  return pow(0.5, log(10.0) / (0.8 * tone_log1p(maximum) * ((maximum + 1.0) / maximum)));
}

vec3 drago(vec3 exposed, ToneParams p, vec3 weights, bool guarded) {
  vec3 c = tone_clean(exposed);
  float l = dot(c, weights);
  float maximum = max(1e-6, p.maximum / p.adaptation);
  float bias = guarded ? max(p.drago_bias, drago_smallest_bias(maximum)) : p.drago_bias;
  return tone_by_luminance(c, l, drago_luminance(min(maximum, l / p.adaptation), maximum, bias));
}

vec3 tone_drago(vec3 exposed, ToneParams p) {
  return drago(exposed, p, tone_rec709, true);
}

vec3 tone_drago2006(vec3 exposed, ToneParams p) {
  return drago(exposed, p, vec3(0.299, 0.587, 0.114), false);
}
