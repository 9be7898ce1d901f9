// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Masks let light through, as rays do.

uniform sampler2D base_map;
uniform float alpha, alpha_cutoff;

in vec2 base_uv;

void main() {
  if (texture(base_map, base_uv).a * alpha < alpha_cutoff) discard;
}
