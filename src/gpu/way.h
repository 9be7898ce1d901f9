// SPDX-License-Identifier: Apache-2.0
// Which of the two ways to mix is the cheaper one, by measurement.
#pragma once

#include <memory>

#include "gpu/mix.h"
#include "gpu/view.h"

namespace sconce::gpu {

/// In seconds, as measured on the device.
struct MixCosts {
  double mix = 0;          ///< of the whole atlas, once per change of a fader
  double atlas_frame = 0;  ///< of a picture that looks at it
  double pixel_frame = 0;  ///< of a picture that mixes in every pixel

  /// @param frames  drawn per change of a fader
  bool atlas_pays(double frames) const { return mix + frames * atlas_frame <= frames * pixel_frame; }
};

/// Draws with one sample per pixel, both ways, best of `rounds`.
MixCosts measure_mix(View& view, const AtlasMix& atlas, const PixelMix& pixel, const Camera& camera,
                     const std::vector<Rgb>& weights, PictureParams params, int rounds = 1);

/// The layers as a light source that was chosen for a picture: by measurement where it has many samples to
/// spend, else the atlas; per pixel where the tier has no float textures, and the atlas where one shader
/// cannot read all.
std::unique_ptr<LightSource> choose_mix(const Context& context, View& view, const EncodedLayers& layers,
                                        const ShaderTier& tier, const Camera& camera,
                                        const std::vector<Rgb>& weights, const PictureParams& params);

}  // namespace sconce::gpu
