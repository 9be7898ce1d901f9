// SPDX-License-Identifier: Apache-2.0
// What of a package's layers a device can take.
#pragma once

#include "gpu/context.h"
#include "mix/encoded_layers.h"
#include "shader/composer.h"

namespace sconce::gpu {

/// Layers of which this tier has no textures are encoded anew (tier_encoding), what is too bright for halves
/// in 8 bits with an exponent. @throws Error when there are no layers
EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier);

/// The best tier of all that the device has.
const ShaderTier& tier_of(const Capabilities& can);

}  // namespace sconce::gpu
