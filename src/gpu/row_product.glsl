// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Twin of multiply(ClusterRows): rows as combinations of their cluster's sixteen. A thread for each two rows, whose
// weights share words.

layout(local_size_x = 128) in;

layout(std430, binding = 0) readonly buffer Weights { int weights[]; };
layout(std430, binding = 1) readonly buffer Scales { float scales[]; };
layout(std430, binding = 2) readonly buffer Sums { vec4 sums[]; };
layout(std430, binding = 3) writeonly buffer Out { vec4 result[]; };
layout(std430, binding = 4) readonly buffer Albedo { vec4 albedo[]; };
layout(std430, binding = 5) buffer Total { vec4 total[]; };

uniform uint rows, cluster;
uniform bool plain;     // rows are the sums themselves; there are no weights
uniform bool reflects;  // light leaves again, and is added up; otherwise what truncated rows leave below zero is darkness

void put(uint row, vec3 light) {
  if (row >= rows) return;
  vec4 e = vec4(plain ? sums[row].rgb : scales[row] * light, 0.0);
  if (reflects) {
    e *= albedo[row];
    total[row] += e;
  } else {
    e = max(e, vec4(0.0));
  }
  result[row] = e;
}

void main() {
  uint item = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
              gl_LocalInvocationID.x;
  uint row = 2u * item;
  if (row >= rows) return;
  uint basis = 16u * (row / cluster), word = 128u * (item / 8u) + item % 8u;
  vec3 one = vec3(0.0), other = vec3(0.0);
  for (uint j = 0u; j < 16u && !plain; ++j) {
    vec3 b = sums[basis + j].rgb;
    int w = weights[word + 8u * j];
    one += float(bitfieldExtract(w, 0, 16)) * b;
    other += float(w >> 16) * b;
  }
  put(row, one);
  put(row + 1u, other);
}
