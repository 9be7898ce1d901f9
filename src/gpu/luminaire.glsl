// SPDX-License-Identifier: Apache-2.0
// A measured luminaire: lamp_intensity times the table's candela. Its frame: C0 to the right, C90 up, nadir along the axis.

uniform sampler2D table;  // columns C from 0 to 360 degrees, rows gamma from 0 to 180, both ends included

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P, p = -to * lamp_frame;
  float d2 = dot(to, to), turn = atan(p.y, p.x) / 6.2831853;
  vec2 at = vec2(turn < 0.0 ? turn + 1.0 : turn, atan(length(p.xy), -p.z) / 3.14159265);  // acos is less exact
  ivec2 last = textureSize(table, 0) - 1;
  at *= vec2(last);
  ivec2 a = ivec2(at), b = min(a + 1, last);
  // Not by the texture unit, whose weights have 8 bits.
  vec2 ends = mix(vec2(texelFetch(table, a, 0).r, texelFetch(table, ivec2(a.x, b.y), 0).r),
                  vec2(texelFetch(table, ivec2(b.x, a.y), 0).r, texelFetch(table, b, 0).r), fract(at.x));
  float candela = mix(ends.x, ends.y, fract(at.y));
  return lamp_intensity * (candela * max(dot(N, to), 0.0) / (d2 * sqrt(d2)));
}
