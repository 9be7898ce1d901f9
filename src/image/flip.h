// SPDX-License-Identifier: Apache-2.0
// How strongly an observer sees two pictures differ who flips between them. Source: Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc.
// ACM Comput. Graph. Interact. Tech. 3(2), 2020.
#pragma once

#include "image/image.h"

namespace sconce {

/// A display 0.7 m wide with 3840 pixels, seen from 0.7 m: the paper's observer.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

struct Flip {
  double mean = 0;  ///< over all pixels; 0 = equal, 1 = as far apart as can be
  Image map;        ///< channel "flip", per pixel, [0, 1]
};

/// R, G and B with all values in [0, 1]: light of a display, 1 = its white. FLIP is of such pictures alone.
bool is_display_light(const Image& image);

/// LDR-FLIP of the two, linear Rec. 709; equal in both directions.
/// @throws Error when sizes differ or one is no display light
Flip flip(const Image& a, const Image& b, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace sconce
