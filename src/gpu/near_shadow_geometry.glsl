// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Every triangle into as many layers as a pass has room for: what terms of a light field see of the scene through the
// measurement plane. Depth near_end / z, as in gpu/shadow_vertex.glsl.

layout(triangles, invocations = 32) in;
layout(triangle_strip, max_vertices = 3) out;

layout(std430, binding = 6) readonly buffer NearTerms { vec4 near_terms[]; };
uniform int near_first, near_layer, near_count;  // term and layer of the first invocation; how many there are
uniform float near_distance, near_end, size;
uniform vec2 near_low, near_texel;

in vec3 local[];
in vec2 base_at[];
out vec2 base_uv;

void main() {
  if (gl_InvocationID >= near_count) return;
  vec2 centre = near_terms[near_first + gl_InvocationID].xy;
  if (local[0].z >= 0.0 && local[1].z >= 0.0 && local[2].z >= 0.0) return;
  for (int i = 0; i < 3; ++i) {
    float depth = -local[i].z;
    vec2 texel = ((centre - near_low) * depth + (local[i].xy - centre) * near_distance) / near_texel;
    gl_Layer = near_layer + gl_InvocationID;
    gl_Position = vec4(2.0 * texel / size - depth, near_end, depth);
    base_uv = base_at[i];
    EmitVertex();
  }
  EndPrimitive();
}
