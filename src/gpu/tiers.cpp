// SPDX-License-Identifier: Apache-2.0
#include "gpu/tiers.h"

namespace sconce::gpu {

const ShaderTier& tier_of(const Capabilities& can) {
  for (const ShaderTier& tier : shader_tiers())
    if ((can.float_linear || !tier.filter || !tier.f32) && (can.bc6h || !tier.bc6h)) return tier;
  return shader_tiers().back();
}

}  // namespace sconce::gpu
