// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Twin of transfer/haar.cpp: squares lie along their Z-order curve, so that a group's 1,024 entries in a row are a
// square of 32 x 32, of which it makes five levels. What is left, an average per group, is a square for the next run.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer From { vec4 from[]; };
layout(std430, binding = 1) buffer To { vec4 to[]; };
layout(std430, binding = 2) writeonly buffer Averages { vec4 averages[]; };
layout(std430, binding = 3) readonly buffer Weights { vec4 albedo_and_weight[]; };

uniform uint size;     // of `from`
uniform float factor;  // of what is written
uniform bool more;     // it is added
uniform bool weighed;  // from light of slots as it is

shared vec4 square[1024];

void put(uint i, vec4 value) {
  to[i] = (more ? to[i] : vec4(0.0)) + factor * value;
}

void main() {
  uint thread = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, count = min(1024u, size);
  for (uint i = thread; i < count; i += 256u) {
    square[i] = from[1024u * group + i];
    if (weighed && albedo_and_weight[1024u * group + i].w > 0.0) square[i] *= albedo_and_weight[1024u * group + i].w;
  }
  barrier();
  uint n = size / 4u, first = 256u * group;  // averages of this level, the group's first
  for (uint blocks = count / 4u; blocks > 0u; blocks /= 4u) {
    vec4 average = vec4(0.0);
    if (thread < blocks) {
      vec4 p = square[4u * thread], q = square[4u * thread + 1u], r = square[4u * thread + 2u],
           s = square[4u * thread + 3u];
      uint m = first + thread;
      put(n + m, 0.5 * (p - q + r - s));
      put(2u * n + m, 0.5 * (p + q - r - s));
      put(3u * n + m, 0.5 * (p - q - r + s));
      average = 0.5 * (p + q + r + s);
    }
    barrier();
    if (thread < blocks) square[thread] = average;
    barrier();
    n /= 4u;
    first /= 4u;
  }
  if (thread == 0u) {
    if (size <= 1024u)
      put(0u, square[0]);
    else
      averages[group] = square[0];
  }
}
