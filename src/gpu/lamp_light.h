// SPDX-License-Identifier: Apache-2.0
// A light shader's light as numbers, for those who follow rays and know no shaders.
#pragma once

#include "core/receiver.h"
#include "gpu/direct_light.h"
#include "transfer/folded_bounces.h"

namespace sconce::gpu {

class LampLight {
 public:
  /// Compiles, and draws the shadow maps of all as it stands now. The context must outlive it.
  /// @throws as DirectLight
  LampLight(const Context& context, const Geometry& geometry, const Bounds& bounds, LampShader lamp);

  /// Direct illuminance at points, lux.
  std::vector<Rgb> at(std::span<const SurfacePoint> points);
  /// Direct illuminance at the middles of an operator's receivers, and what bounces add, lux.
  std::vector<Rgb> on_receivers(const Operator& op, const FoldedBounces& bounces);
  /// What was no number when one of them was asked last.
  Mishap mishap() const;

 private:
  std::vector<Rgbx> exitance(std::span<const OperatorPoint> points, uint32_t per_slot);

  const Context* context_;
  DirectLight direct_;
};

}  // namespace sconce::gpu
