// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "image/image.h"

namespace sconce {

/// sum += weight * layer, in float. Called in the order of the groups, so any number of threads gives the
/// same bits.
/// @param sum       RGB, as large as `layer`
/// @param channels  which of the layer's channels are red, green and blue
void accumulate(Image& sum, const Rgb& weight, const Image& layer, std::span<const std::size_t, 3> channels);

}  // namespace sconce
