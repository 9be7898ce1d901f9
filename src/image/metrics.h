// SPDX-License-Identifier: Apache-2.0
// How far two images are apart. Definitions: contract.md, "Relative RMSE".
#pragma once

#include <cstddef>

#include "image/image.h"

namespace sconce {

/// Pixel by pixel, over all channels of both (a is judged, b is the reference). NaN and infinities on either
/// side make every figure NaN, so that no limit is met by them.
struct Comparison {
  double mse = 0;  ///< mean of (a - b)^2
  double relmse =
      0;           ///< mean of (a - b)^2 / (b^2 + 0.01 mean(b)^2); free of scale, dark pixels do not dominate
  double max = 0;  ///< largest |a - b|
  double mean_ratio =
      1;  ///< mean luminance of a / of b (of the channels' mean where there are not three); NaN for 0/0
  std::size_t not_finite = 0;  ///< pixels with a NaN or infinity in a or b
};
/// @throws Error when sizes or channels differ
Comparison compare(const Image& a, const Image& b);

/// contract.md's figure for all bars. Pixels where the mask, dilated by one pixel, is above 0 are dropped; a
/// box of 4 x 4 pixels (smaller at the right and bottom edge) is kept when at least half of its pixels are,
/// and its value is their mean. With r = (s0 + s1) / 2:
///   mse   = mean over kept boxes and channels of (picture - r)^2
///   noise = mean over kept boxes and channels of (s0 - s1)^2 / 4, the variance of r
///   rmse  = sqrt(max(0, mse - noise)) / mean of r over kept pixels and channels
struct RelativeRmse {
  double rmse = 0;        ///< relative; NaN when the picture holds NaN or infinities or nothing is kept
  double mean_ratio = 1;  ///< mean luminance of the picture / of r, over kept pixels
  double noise = 0;       ///< sqrt(noise) / mean of r: what rmse was freed of; 0 without s1
  std::size_t kept = 0;   ///< boxes
  std::size_t kept_pixels = 0;
  Image boxes;  ///< channel "error": root mean square over channels / mean of r, per box; -1 = dropped
};
/// @param s0, s1  independent renderings of the reference; s1 may be null (then noise is 0)
/// @param mask    coverage of visible emitters, any channels; may be null
/// @throws Error when sizes or channels differ
RelativeRmse relative_rmse(const Image& picture, const Image& s0, const Image* s1, const Image* mask);

inline constexpr int kBox = 4;  ///< pixels along a box

/// False colour of |a - b| / mean(b), logarithmic from 0.1 % (black) over blue, green and yellow to 100 %
/// (white), NaN magenta; grey where dropped. The worst 1 % of `boxes` (at least one, none without error) have
/// a red frame.
Image8 error_picture(const Image& a, const Image& b, const Image* mask, const Image& boxes);

/// The colours of error_picture for values of one channel from 0 (black) to 1 (white).
Image8 false_color(const Image& map);

}  // namespace sconce
