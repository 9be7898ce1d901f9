// SPDX-License-Identifier: Apache-2.0
#version 450 core

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 base_place;

uniform vec3 near_position;
uniform mat3 near_frame;

out vec3 local;  // in the luminaire's frame
out vec2 base_at;

void main() {
  local = (position - near_position) * near_frame;
  base_at = base_place;
}
