// SPDX-License-Identifier: Apache-2.0
// Mantissas at the middle of their step, exponent + 128 in alpha; alpha 0 is black.
vec4 decode_rgbe8(vec4 texel, vec4 gain) {
  vec4 code = floor(texel * 255.0 + 0.5);
  return code.a > 0.0 ? vec4((code.rgb + 0.5) * exp2(code.a - 136.0), 0.0) : vec4(0.0);
}
