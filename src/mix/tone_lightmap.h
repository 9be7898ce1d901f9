// SPDX-License-Identifier: Apache-2.0
// System A's software path: groups combined and tone mapped on the CPU into a lightmap that any texturing
// hardware can take, made anew when a fader moves.
#pragma once

#include <span>
#include <vector>

#include "image/image.h"
#include "tone/exposure.h"

namespace sconce {

/// Per page, sRGB codes of tone(E / pi * exposure): what a white diffuse surface shows.
/// @param pages  mix_pages() or Mixer::mix()
/// @throws Error where they are not R, G, B
std::vector<Image8> tone_lightmap(std::span<const Image> pages, const Exposure& exposure,
                                  const ToneMapper& mapper);

}  // namespace sconce
