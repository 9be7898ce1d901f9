// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering over 3 x 3 texels, bilinear. No bias to be tuned: every texel's depth is compared with
// that of the receiver's own plane in the middle of that texel, which is known exactly (1 / z is linear on the map).

uniform sampler2DArray sconce_shadow;
uniform int sconce_views;                              // 0 no shadows, 1 one map, 6 a cube: +x -x +y -y +z -z of the lamp
uniform bool sconce_parallel;
uniform vec3 sconce_eye;
uniform mat3 sconce_to_plane[6], sconce_from_plane[6];  // shadow_vertex.glsl, and back
uniform float sconce_near;

int sconce_view(vec3 d) {
  if (sconce_views < 6) return 0;
  vec3 local = d * lamp_frame, size = abs(local);
  if (size.x >= size.y && size.x >= size.z) return local.x > 0.0 ? 0 : 1;
  if (size.y >= size.z) return local.y > 0.0 ? 2 : 3;
  return local.z > 0.0 ? 4 : 5;
}

// Share of the lamp that a surface sees. N: shading normal; where it differs from the face's, neighbouring faces bend away.
float sconce_visible(vec3 P, vec3 N, vec3 face) {
  if (sconce_views == 0) return 1.0;
  vec3 d = P - sconce_eye;
  int view = sconce_view(d);
  vec3 q = sconce_to_plane[view] * d;
  float size = float(textureSize(sconce_shadow, 0).x);
  if (!sconce_parallel && q.z <= 0.0) return 0.0;
  vec2 at = sconce_parallel ? q.xy : q.xy / q.z;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(size)))) return sconce_parallel ? 1.0 : 0.0;
  // The plane as the map has it: dot(m, (x, y, 1)) z = c, or dot(m, (x, y, z)) = c for parallel light.
  vec3 m = face * sconce_from_plane[view];
  float c = dot(face, d);
  vec3 slope = sconce_parallel ? vec3(-m.xy, c) / m.z : sconce_near * m / c;
  // What rasterisation may be off: depth's own rounding, and corners that snap to 1/256 of a texel.
  float slack = 1e-5 * (sconce_parallel ? 1.0 : sconce_near / q.z) + length(slope.xy) / 32.0;
  // And on a hollow surface of flat faces, how much nearer the next face is two texels on.
  mat3 from = sconce_from_plane[view];
  float cosine = sconce_parallel ? abs(m.z) / length(from[2]) : abs(c) / length(d);
  slack += 4.0 * length(from[0]) * length(N - face) / max(cosine, 0.05) *
           (sconce_parallel ? 1.0 / length(from[2]) : sconce_near / q.z);
  vec2 low = floor(at - 0.5), part = at - 0.5 - low;
  float sum = 0.0;
  for (int y = -1; y <= 2; ++y)
    for (int x = -1; x <= 2; ++x) {
      vec2 weight = vec2(x == -1 ? 1.0 - part.x : x == 2 ? part.x : 1.0, y == -1 ? 1.0 - part.y : y == 2 ? part.y : 1.0);
      ivec2 texel = clamp(ivec2(low) + ivec2(x, y), ivec2(0), ivec2(size) - 1);
      float plane = dot(slope, vec3(vec2(texel) + 0.5, 1.0));
      float seen = texelFetch(sconce_shadow, ivec3(texel, view), 0).r;
      sum += seen <= plane + slack ? weight.x * weight.y : 0.0;
    }
  return sum / 9.0;
}
