// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "relight/receivers.h"

namespace sconce {

/// What lamps of equal strength at random places throw onto the operator's cloud: b_d per slot, one square
/// each. They stand where they are looked at: between receivers and the camera, or on cosine-distributed rays
/// from receivers; points and spots in turn.
/// @param middles  of the receivers
std::vector<std::vector<Rgbx>> training_lights(const TracedScene& traced, const RelightReceivers& receivers,
                                               std::span<const SurfacePoint> middles, const Operator& op,
                                               int count, uint32_t seed, const Progress& progress = {});

}  // namespace sconce
