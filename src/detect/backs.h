// SPDX-License-Identifier: Apache-2.0
// Whether a renderer lights the backs of faces, too.
#pragma once

#include "detect/materials.h"

namespace sconce {

/// A face, and the brightest white card in its place.
struct CardedFace {
  const DetectedFace* face;
  float card;
};

/// Draws faces as seen from behind, with one light behind each.
/// @return per material: whether those of it reflect light there
std::vector<uint8_t> lit_backs(const World& world, const HostRenderer& host,
                               std::span<const CardedFace> faces, std::size_t materials, int texels,
                               const Progress& progress, CaptureCost& cost);

}  // namespace sconce
