// SPDX-License-Identifier: Apache-2.0
// Layers as a class of devices can take them.
#pragma once

#include "mix/encoded_layers.h"
#include "shader/composer.h"

namespace sconce {

/// Layers of which this tier has no textures are encoded anew (tier_encoding), what is too bright for halves
/// in 8 bits with an exponent. @throws Error when there are no layers
EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier);

}  // namespace sconce
