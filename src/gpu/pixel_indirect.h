// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu/seen_surfaces.h"
#include "transfer/operator.h"

namespace sconce::gpu {

/// Indirect light of an operator for a camera's pixels, in pictures of that camera and size.
class PixelIndirect : public AddedLight {
 public:
  /// @param illuminance  Transfer's; must outlive it
  /// @param diagonal     of the scene's bounds, m
  PixelIndirect(const Context& context, const Operator& op, const Buffer& illuminance, float diagonal);
  void add(const SeenSurfaces& seen, const Texture& picture) override;

 private:
  const Context* context_;
  Program program_;
  Buffer points_, receiver_of_;
  const Buffer* illuminance_;
};

}  // namespace sconce::gpu
