// SPDX-License-Identifier: Apache-2.0
// 1 - exp(-gain x); the last code is 254.
vec4 decode_exp8(vec4 texel, vec4 gain) {
  return -log(max(vec4(1.0) - texel, vec4(1.0 / 255.0))) / gain;
}
