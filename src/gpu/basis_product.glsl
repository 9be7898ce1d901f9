// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Twin of transfer/multiply.cpp: the sixteen rows of a block, kept as codes of a few wavelet coefficients, times
// transformed light. A group for each block; four threads side by side read one coefficient's sixteen codes.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer First { uint first[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };  // two in a word
layout(std430, binding = 2) readonly buffer Codes { int codes[]; };       // four in a word
layout(std430, binding = 3) readonly buffer Scales { float scales[]; };
layout(std430, binding = 4) readonly buffer Means { float means[]; };
layout(std430, binding = 5) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 6) writeonly buffer Sums { vec4 sums[]; };

uniform uint blocks;

shared vec4 parts[4][256];

void main() {
  uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (block >= blocks) return;
  uint thread = gl_LocalInvocationID.x, quarter = thread & 3u;
  vec3 sum[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  for (uint k = first[block] + (thread >> 2u); k < first[block + 1u]; k += 64u) {
    uint index = (indices[k >> 1u] >> (16u * (k & 1u))) & 0xffffu;
    vec3 l = light[index].rgb;
    int word = codes[4u * k + quarter];
    for (int r = 0; r < 4; ++r) {
      float code = float(bitfieldExtract(word, 8 * r, 8));
      sum[r] += code * abs(code) * l;
    }
  }
  for (int r = 0; r < 4; ++r) parts[r][thread] = vec4(sum[r], 0.0);
  barrier();
  for (uint half_way = 128u; half_way >= 4u; half_way /= 2u) {
    if (thread < half_way)
      for (int r = 0; r < 4; ++r) parts[r][thread] += parts[r][thread + half_way];
    barrier();
  }
  if (thread < 16u) {
    uint row = 16u * block + thread;
    sums[row] = scales[row] / (127.0 * 127.0) * parts[thread & 3u][thread >> 2u] + means[row] * light[0];
  }
}
