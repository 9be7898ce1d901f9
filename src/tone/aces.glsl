// SPDX-License-Identifier: Apache-2.0
// Twin of aces.cpp, which names the sources.

vec3 tone_aces(vec3 exposed, ToneParams p) {
  // Written row by row, hence multiplied from the right.
  const mat3 to_rrt = mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777);
  const mat3 from_odt =
      mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602);
  vec3 v = tone_clean(exposed) * to_rrt;
  v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return clamp(v * from_odt, 0.0, 1.0);
}
