// SPDX-License-Identifier: Apache-2.0
vec4 decode_f16(vec4 texel, vec4 gain) {
  return texel;
}
