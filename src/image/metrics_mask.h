// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "image/image.h"

namespace sconce {

/// Per pixel: 1 where no pixel of its 3 x 3 neighbourhood is covered (any channel of the mask above 0), else
/// 0. All 1 without a mask. @throws Error when the mask has another size
std::vector<char> kept_pixels(const Image* mask, int width, int height);

}  // namespace sconce
