// SPDX-License-Identifier: Apache-2.0
// A lamp's light field by eq. 14 of Granier, Goesele, Heidrich and Seidel 2003, after gpu/shadow_filter.glsl: every term
// a textured spot at its filter's centre, with a shadow map of its own. Twin of NearLamp::terms().

uniform isampler2DArray near_sums;  // per term: of E' over all pixels left and below, in codes
uniform sampler2DArray near_depths;  // per term of this pass
layout(std430, binding = 6) readonly buffer NearTerms { vec4 near_terms[]; };  // centre on S, m; lux m2 per code
uniform int near_first, near_count;  // terms of this pass
uniform bool near_shadows;
uniform vec3 near_position, near_color;
uniform mat3 near_frame;  // v * near_frame is v in the luminaire's frame
uniform float near_distance, near_filter, near_pixel, near_end;  // m; near_end: of the shadow maps
uniform vec2 near_corner;           // of M's pixels, m
uniform vec2 near_low, near_texel;  // corner and texels of the shadow maps on M, m

// Mean of E' over a square of M. Differences of sums are whole numbers, so exact.
float near_mean(int term, vec2 st, float size) {
  ivec2 pixels = textureSize(near_sums, 0).xy - 1;
  vec2 at = (st - near_corner) / near_pixel;
  float reach = 0.5 * max(1.0, size / near_pixel);
  vec2 low = clamp(at - reach, vec2(0.0), vec2(pixels)), high = clamp(at + reach, vec2(0.0), vec2(pixels));
  if (any(greaterThanEqual(low, high))) return 0.0;
  // The first and the last column count by what is covered of them, those between in full; rows likewise.
  ivec2 first = min(ivec2(low), pixels - 1), last = clamp(ivec2(ceil(high)) - 1, first, pixels - 1);
  bvec2 one = equal(first, last);
  vec2 begin = mix(vec2(first + 1) - low, high - low, one), end = mix(high - vec2(last), vec2(0.0), one);
  // Sums at the corners of both: squares of four, which a gather reads at once around the point that they share.
  vec2 scale = 1.0 / vec2(pixels + 1), near = vec2(first + 1) * scale, far = vec2(max(last, first + 1) + 1) * scale;
  ivec4 a = textureGather(near_sums, vec3(near, term)), b = textureGather(near_sums, vec3(far.x, near.y, term)),
        c = textureGather(near_sums, vec3(near.x, far.y, term)), d = textureGather(near_sums, vec3(far, term));
  ivec4 row[4] = ivec4[4](ivec4(a.wz, b.wz), ivec4(a.xy, b.xy), ivec4(c.wz, d.wz), ivec4(c.xy, d.xy));
  vec3 wx = vec3(begin.x, 1.0, end.x), wy = vec3(begin.y, 1.0, end.y);
  ivec3 below = row[0].yzw - row[0].xyz;
  float sum = 0.0;
  for (int j = 0; j < 3; ++j) {
    ivec3 above = row[j + 1].yzw - row[j + 1].xyz;
    sum += wy[j] * dot(vec3(above - below), wx);
    below = above;
  }
  return sum / (4.0 * reach * reach);
}

// Where light arrives, in the luminaire's frame.
struct NearPlace {
  bool below;  // the sampling plane; else nothing arrives
  vec3 x, normal, face;
  float bend;
};

NearPlace near_place(vec3 P, vec3 N, vec3 face, float bend) {
  NearPlace p = NearPlace(false, (P - near_position) * near_frame, N * near_frame, face * near_frame, bend);
  p.below = p.x.z < -1e-6;
  return p;
}

// To the centre of the i-th filter of this pass, m.
vec3 near_way(int i, NearPlace p) { return vec3(near_terms[near_first + i].xy, 0.0) - p.x; }

float near_visible(int layer, vec2 centre, vec2 st, NearPlace p) {
  mat3 from = mat3(near_texel.x / near_distance, 0.0, 0.0, 0.0, near_texel.y / near_distance, 0.0,
                   (near_low - centre) / near_distance, -1.0);
  return sconce_filtered(near_depths, layer, (st - near_low) / near_texel, -p.x.z, p.x - vec3(centre, 0.0), from,
                         near_end, false, p.face, p.bend);
}

// By the i-th term of this pass, whose centre lies at `to`: lux, with its shadow. cosine: of the surface.
float near_lux(int i, NearPlace p, vec3 to, float cosine) {
  vec4 term = near_terms[near_first + i];
  float depth = -p.x.z, ratio = near_distance / depth, d2 = dot(to, to);
  vec2 st = term.xy - to.xy * ratio;
  float mean = near_mean(near_first + i, st, near_filter * abs(1.0 - ratio));
  float value = term.z * mean * depth * cosine / (d2 * sqrt(d2));
  return value != 0.0 && near_shadows ? value * near_visible(i, term.xy, st, p) : value;
}
