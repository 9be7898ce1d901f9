// SPDX-License-Identifier: Apache-2.0
// What a device can take.
#pragma once

#include "gpu/context.h"
#include "mix/tier_layers.h"

namespace sconce::gpu {

/// The best tier of all that the device has.
const ShaderTier& tier_of(const Capabilities& can);

}  // namespace sconce::gpu
