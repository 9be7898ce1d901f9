// SPDX-License-Identifier: Apache-2.0
// Unit vectors as two numbers: twin of pack_normal() and unpack_normal().

vec3 sconce_octahedral(vec2 p) {
  float z = 1.0 - abs(p.x) - abs(p.y);
  vec2 fold = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return normalize(z >= 0.0 ? vec3(p, z) : vec3(fold, z));
}

// Of two shorts in a word.
vec3 sconce_octahedral(uint word) {
  return sconce_octahedral(vec2(bitfieldExtract(int(word), 0, 16), int(word) >> 16) / 32767.0);
}

vec2 sconce_to_octahedral(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}
