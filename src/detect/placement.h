// SPDX-License-Identifier: Apache-2.0
// Whether the light that a renderer shows on a face depends on where on the target the face is drawn.
#pragma once

#include "detect/capture.h"

namespace sconce {

/// Draws the same faces with all lights at several places, far apart on a target as large as a screen.
/// @return largest difference of a face's light, as a share of it
float placement_residual(const HostRenderer& host, std::span<const uint32_t> triangles, int texels,
                         CaptureCost& cost);

}  // namespace sconce
