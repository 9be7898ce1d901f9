// SPDX-License-Identifier: Apache-2.0
// Indirect light of an operator for pixels on what a picture shows, after gpu/seen_surfaces.glsl: of the nearest in
// place and normal among 3 x 3 (system C, 9.8.1). Twin of Relighter::nearest_pixel.

layout(std430, binding = 0) readonly buffer Points { uint points[]; };  // OperatorPoint per receiver, seven words
layout(std430, binding = 1) readonly buffer Light { vec4 light[]; };    // per receiver
layout(std430, binding = 2) readonly buffer ReceiverOf { uint receiver_of[]; };  // per pixel

uniform float diagonal;  // of the scene's bounds, m

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = imageSize(sconce_seen) - 1;
  SconceSurface s = sconce_surface(at);
  if (!s.there) return;
  vec3 e = vec3(0.0);
  float least = 3.4e38;
  for (int y = max(0, at.y - 1); y <= min(last.y, at.y + 1); ++y)
    for (int x = max(0, at.x - 1); x <= min(last.x, at.x + 1); ++x) {
      uint i = receiver_of[y * (last.x + 1) + x];
      if (i == 0xffffffffu) continue;
      vec3 p = uintBitsToFloat(uvec3(points[7u * i], points[7u * i + 1u], points[7u * i + 2u]));
      vec3 d = 20.0 * (p - s.place), r = diagonal * (sconce_octahedral(points[7u * i + 3u]) - s.normal);
      float off = dot(d, d) + dot(r, r);
      if (off >= least) continue;
      least = off;
      e = light[i].rgb;
    }
  sconce_add(at, s, e);
}
