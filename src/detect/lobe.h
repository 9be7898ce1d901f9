// SPDX-License-Identifier: Apache-2.0
// What a surface does that a diffuse one does not, as one lobe.
#pragma once

#include <optional>

#include "detect/capture.h"

namespace sconce {

/// Diffuse reflectance x cosine + strength x cos(angle)^exponent, both times what a white card that faces the
/// light shows; light in the mirror's direction is at angle 0 (Phong), or where the normal is halfway between
/// light and eye (Blinn).
struct Lobe {
  bool halfway = false;
  Rgb diffuse, strength;
  float exponent = 0;
  float residual = 0;  ///< under lights and eyes that were not fitted to: share of a white card's light

  /// As the width of a microfacet distribution: sqrt(2 / (n + 2)) of the halfway exponent n, which is about
  /// four times the mirror's.
  float roughness() const { return std::sqrt(2 / ((halfway ? exponent : 4 * exponent) + 2)); }
};

/// Fits a lobe to 27 lights and eyes, every texel of a face by itself, with the World's normals.
/// @param emission  of the face
/// @return nothing where the face does not answer
std::optional<Lobe> fit_lobe(const World& world, const HostRenderer& host, uint32_t triangle,
                             const Rgb& emission, int texels, CaptureCost& cost);

}  // namespace sconce
