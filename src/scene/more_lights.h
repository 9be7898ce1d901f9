// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "scene/scene.h"

namespace sconce {

/// Lights that join a scene, with the measured lamps that they name.
struct MoreLights {
  std::vector<Light> lights{};
  std::vector<Luminaire> luminaires{};  ///< that LuminaireLight::luminaire of these lights numbers
};

/// @param to  a Scene, or more of MoreLights
template <class Lit>
void append(Lit& to, MoreLights more) {
  const std::size_t known = to.luminaires.size();
  for (Luminaire& luminaire : more.luminaires) to.luminaires.push_back(std::move(luminaire));
  for (Light& light : more.lights) {
    if (auto* measured = std::get_if<LuminaireLight>(&light.shape))
      measured->luminaire = Id<Luminaire>(known + measured->luminaire.value);
    to.lights.push_back(std::move(light));
  }
}

}  // namespace sconce
