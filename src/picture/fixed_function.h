// SPDX-License-Identifier: Apache-2.0
// What texturing hardware without shaders shows of a package, by the paper's software path: the lightmap is
// tone mapped before the texture, since nothing can be computed after it.
#pragma once

#include "mix/mix.h"
#include "picture/hits.h"
#include "tone/exposure.h"

namespace sconce {

/// min(1, A * T + L) per channel, all of them sRGB codes in [0,1], not decoded anywhere: A = 8-bit code of
/// the albedo, T = the lightmap looked up bilinearly (GL_MODULATE), L = tone curve of what shines by itself,
/// alone. The right order codes tone(albedo * E / pi) instead; both agree where the albedo is 1.
/// @param lightmap  tone_lightmap() of the same mix, exposure and curve
/// @throws Error when the mix or its pages are of another package
Image fixed_function(const CameraHits& hits, const MixSpec& mix, const std::vector<Image8>& lightmap,
                     const Exposure& exposure, const ToneMapper& mapper);

}  // namespace sconce
