// SPDX-License-Identifier: Apache-2.0
// For tests only: exposed colours that try a curve.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/rgb.h"

namespace sconce {

/// Greys, primaries and mixtures over 40 stops, black, negative and enormous channels, and many at random.
inline std::vector<Rgb> test_colors() {
  std::vector<Rgb> out;
  for (float stops = -20; stops <= 20; stops += 0.125f) {
    const float v = std::exp2(stops);
    for (const Rgb& c :
         {Rgb(v), Rgb(v, 0, 0), Rgb(0, v, 0), Rgb(0, 0, v), Rgb(v, v, 0), Rgb(v, 0.5f * v, 0.1f * v)})
      out.push_back(c);
  }
  for (const float v : {0.0f, -1.0f, 1e-30f, 1e9f, 1e30f})
    for (const float w : {0.0f, -0.5f, 0.18f, 1e9f}) out.push_back({v, w, 1});
  std::mt19937 random(7);
  std::uniform_real_distribution<float> stop(-16, 12);
  for (int i = 0; i < 5000; ++i)
    out.push_back({std::exp2(stop(random)), std::exp2(stop(random)), std::exp2(stop(random))});
  return out;
}

}  // namespace sconce
