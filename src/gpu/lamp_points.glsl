// SPDX-License-Identifier: Apache-2.0
// A lamp on the points of an operator's cloud (OperatorPoint): what they reflect, albedo x illuminance, lm/m2. Points
// whose answer is no number leave their slot to its others.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer SconcePoints { uint sconce_points[]; };  // seven words each
layout(std430, binding = 1) buffer SconceLight { vec4 sconce_light[]; };

uniform uint sconce_slots, sconce_per_slot;

void main() {
  uint slot = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (slot >= sconce_slots) return;
  vec3 sum = vec3(0.0);
  uint good = 0u;
  for (uint i = sconce_per_slot * slot; i < sconce_per_slot * (slot + 1u); ++i) {
    vec3 P = uintBitsToFloat(uvec3(sconce_points[7u * i], sconce_points[7u * i + 1u], sconce_points[7u * i + 2u]));
    vec3 N = sconce_octahedral(sconce_points[7u * i + 3u]), face = sconce_octahedral(sconce_points[7u * i + 4u]), e;
    if (!sconce_arriving(P, N, face, length(N - face), e)) {
      sconce_count(i);
      continue;
    }
    ++good;
    uint rg = sconce_points[7u * i + 5u], b = sconce_points[7u * i + 6u];
    sum += e * vec3(rg & 0xffffu, rg >> 16u, b & 0xffffu) / 65535.0;
  }
  sconce_light[slot] += vec4(sum / float(max(good, 1u)), 0.0);
}
