// SPDX-License-Identifier: Apache-2.0
// Whether what was detected holds: lights and eyes that detection has not seen.
#pragma once

#include "detect/materials.h"

namespace sconce {

struct HeldOut {
  float residual = 0;  ///< largest |drawn - predicted|, share of a white card's light
  bool holds = true;   ///< all below the limit, or below what rounding to codes can make
};

/// Predicts emission + reflectance x white card for the largest known face of each material: in the light's
/// mirror direction, back where it comes from, and at grazing angles. Texels of curved faces are also
/// compared with themselves, seen from aside.
/// @param known  faces with their own response
/// @param limit  of residuals
/// @return per material
std::vector<HeldOut> held_out_residuals(const World& world, const HostRenderer& host,
                                        std::span<const DetectedFace> known, std::size_t materials,
                                        int texels, float limit, const Progress& progress, CaptureCost& cost);

}  // namespace sconce
