// SPDX-License-Identifier: Apache-2.0
// Mantissas -127 to 127 around code 128, exponent + 128 in alpha; alpha 0 is black.
vec4 decode_srgbe8(vec4 texel, vec4 gain) {
  vec4 code = floor(texel * 255.0 + 0.5);
  return code.a > 0.0 ? vec4((code.rgb - 128.0) / 127.0 * exp2(code.a - 128.0), 0.0) : vec4(0.0);
}
