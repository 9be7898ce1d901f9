// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering over 3 x 3 texels, bilinear. No bias to be tuned: every texel's depth is compared with
// that of the receiver's own plane in the middle of that texel, which is known exactly (1 / z is linear on the map).

// Share of a lamp that a surface sees.
// at: texels; z: depth; d: from the lamp's eye; to texels and depth: (x, y, 1) z, or (x, y, z) for parallel light; from:
// back to d. bend: between the interpolated normal and the face's; where there is any, neighbouring faces bend away.
float sconce_filtered(sampler2DArray map, int layer, vec2 at, float z, vec3 d, mat3 from, float near, bool parallel,
                      vec3 face, float bend) {
  // The plane as the map has it: dot(m, (x, y, 1)) z = c, or dot(m, (x, y, z)) = c for parallel light.
  vec3 m = face * from;
  float c = dot(face, d);
  vec3 slope = parallel ? vec3(-m.xy, c) / m.z : near * m / c;
  // What rasterisation may be off: depth's own rounding, and corners that snap to 1/256 of a texel.
  float slack = 1e-5 * (parallel ? 1.0 : near / z) + length(slope.xy) / 32.0;
  // And on a hollow surface of flat faces, how much nearer the next face is two texels on.
  float cosine = parallel ? abs(m.z) / length(from[2]) : abs(c) / length(d);
  slack += 4.0 * length(from[0]) * bend / max(cosine, 0.05) * (parallel ? 1.0 / length(from[2]) : near / z);
  vec2 low = floor(at - 0.5), part = at - 0.5 - low;
  ivec2 last = textureSize(map, 0).xy - 1;
  float sum = 0.0;
  for (int y = -1; y <= 2; ++y)
    for (int x = -1; x <= 2; ++x) {
      vec2 weight = vec2(x == -1 ? 1.0 - part.x : x == 2 ? part.x : 1.0, y == -1 ? 1.0 - part.y : y == 2 ? part.y : 1.0);
      ivec2 texel = clamp(ivec2(low) + ivec2(x, y), ivec2(0), last);
      float plane = dot(slope, vec3(vec2(texel) + 0.5, 1.0));
      float seen = texelFetch(map, ivec3(texel, layer), 0).r;
      sum += seen <= plane + slack ? weight.x * weight.y : 0.0;
    }
  return sum / 9.0;
}
