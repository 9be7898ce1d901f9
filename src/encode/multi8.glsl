// SPDX-License-Identifier: Apache-2.0
// The high and the low byte of 65535 steps.
vec4 decode_multi8(vec4 high, vec4 low, vec4 gain) {
  return (high * 65280.0 + low * 255.0) / 65535.0 / gain;
}
