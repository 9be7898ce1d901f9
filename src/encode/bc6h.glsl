// SPDX-License-Identifier: Apache-2.0
// Texture units decode the blocks.
vec4 decode_bc6h(vec4 texel, vec4 gain) {
  return texel;
}
