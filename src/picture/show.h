// SPDX-License-Identifier: Apache-2.0
// Pictures from cached camera hits: no ray is traced and no texture looked up while faders move.
#pragma once

#include "mix/mix.h"
#include "picture/hits.h"
#include "tone/codes.h"

namespace sconce {

/// The picture that View::render() and tone_map() make of one ray per pixel, within one code. The same codes
/// with any number of threads.
/// @param pages  mix_pages() of the same mix, or Mixer::mix()
/// @throws Error when the mix or its pages are of another package
Image8 show(const CameraHits& hits, const MixSpec& mix, const std::vector<Image>& pages,
            const ToneCodes& tone);

/// One row of the picture, linear, cd/m2: rho/pi E without what shines by itself, by vectors (Highway, chosen
/// at run time).
/// @param pages  of the size that the hits are for
/// @param rgb    3 * width + 1 floats
void shade_row(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb);
/// The same plainly: what the fast one is tested and measured against.
void shade_row_plain(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb);

}  // namespace sconce
