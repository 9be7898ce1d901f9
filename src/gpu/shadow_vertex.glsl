// SPDX-License-Identifier: Apache-2.0
#version 450 core
// What a lamp sees: depth near / z, or for parallel light from 1 at the nearest to 0 at the farthest.

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 base_place;

uniform vec3 eye;
uniform mat3 to_plane;  // world -> texel x, texel y, 1 times depth
uniform float size, near;
uniform bool parallel;

out vec2 base_uv;

void main() {
  base_uv = base_place;
  vec3 q = to_plane * (position - eye);
  gl_Position = parallel ? vec4(2.0 * q.xy / size - 1.0, q.z, 1.0) : vec4(2.0 * q.xy / size - q.z, near, q.z);
}
