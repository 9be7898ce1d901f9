// SPDX-License-Identifier: Apache-2.0
// Twin of agx.cpp, which names the sources.

float agx_sigmoid(float x) {
  const float pivot = 10.0 / 16.5;
  if (x <= 0.0 || x >= 1.0) return x <= 0.0 ? 0.0 : 1.0;
  bool above = x > pivot;
  float d = abs(x - pivot);
  if (d < 1e-6) return 0.5;  // pow of 0
  float power = above ? 3.25 : 3.0;
  float scale = above ? 69.86278913545539 : 59.507875;
  float y = 2.0 * d * pow(1.0 + scale * pow(d, power), -1.0 / power);
  return 0.5 + (above ? y : -y);
}

vec3 tone_agx(vec3 exposed, ToneParams p) {
  // Written row by row, hence multiplied from the right.
  const mat3 inset = mat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,
                          0.0423282422610123, 0.878468636469772, 0.0791661274605434,
                          0.0423756549057051, 0.0784336, 0.879142973793104);
  const mat3 outset = mat3(1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                           -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                           -0.0529716355144438, -0.0980434501171241, 1.15107367264116);
  const float log_grey = -2.47393118833;
  vec3 stops = log2(max(tone_clean(exposed) * inset, vec3(1e-10))) - log_grey;
  vec3 x = (stops + 10.0) / 16.5;
  vec3 coded = vec3(agx_sigmoid(x.r), agx_sigmoid(x.g), agx_sigmoid(x.b));
  return pow(clamp(coded * outset, 0.0, 1.0), vec3(2.2));
}
