// SPDX-License-Identifier: Apache-2.0
// A light field that tests make themselves.
#pragma once

#include <cmath>

#include "photometry/light_field.h"

namespace sconce::test {

/// Filters of 10 mm, each a soft spot; those to the right shine further to the right, so that the pattern
/// changes with distance.
inline LightField spots() {
  LightField field = make_light_field(NearBasis::bell, Vec2(-0.01f), Vec2(0.01f), 0.01, 0.25, 0.25, 48);
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m)
      for (int t = 0; t < 48; ++t)
        for (int s = 0; s < 48; ++s) {
          const glm::dvec2 st = field.corner + field.pixel * (glm::dvec2(s, t) + 0.5),
                           middle = 4.0 * field.center(m, n);
          const double d2 = glm::dot(st - middle, st - middle);
          const std::size_t term = static_cast<std::size_t>(n * field.columns + m);
          field.irradiance[term * field.pixels() + static_cast<std::size_t>(48 * t + s)] =
              static_cast<float>((m == 4 ? -100 : 1000) * std::exp(-d2 / (0.2 * 0.2)));
        }
  return field;
}

/// The same in colours: red as it is, green by columns mirrored, blue dim and even over the terms.
inline LightField colored_spots() {
  LightField field = spots();
  for (int c = 0; c < 3; ++c)
    for (std::size_t term = 0; term < field.terms(); ++term) {
      const auto columns = static_cast<std::size_t>(field.columns), m = term % columns;
      for (const float v : field.image(c == 0 ? term : term - m + (c == 1 ? columns - 1 - m : columns / 2)))
        field.color.push_back(c == 2 ? 0.3f * v : v);
    }
  set_luminance(field);
  return field;
}

}  // namespace sconce::test
