// SPDX-License-Identifier: Apache-2.0
#version 450 core
// A small dense matrix per channel times one colour per column (transfer/folded_bounces.h). A group for each row.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Matrices { float matrices[]; };  // red, green, blue, by rows
layout(std430, binding = 1) readonly buffer In { vec4 seen[]; };
layout(std430, binding = 2) writeonly buffer Out { vec4 result[]; };

uniform uint rank;

shared vec3 parts[64];

void main() {
  uint row = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, thread = gl_LocalInvocationID.x;
  if (row >= rank) return;
  vec3 sum = vec3(0.0);
  for (uint j = thread; j < rank; j += 64u) {
    uint at = row * rank + j;
    sum += vec3(matrices[at], matrices[rank * rank + at], matrices[2u * rank * rank + at]) * seen[j].rgb;
  }
  parts[thread] = sum;
  barrier();
  for (uint step = 32u; step > 0u; step /= 2u) {
    if (thread < step) parts[thread] += parts[thread + step];
    barrier();
  }
  if (thread == 0u) result[row] = vec4(parts[0], 0.0);
}
