// SPDX-License-Identifier: Apache-2.0
// A composed shader's textures on the device.
#pragma once

#include <vector>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "gpu/tiers.h"

namespace sconce::gpu {

/// Some of the layers, as many as one shader can read, and the text that mixes them.
class LayerPass {
 public:
  /// @param which  indices of textures
  LayerPass(const Context& context, const EncodedLayers& layers, const ShaderTier& tier,
            ShaderSpec::Form form, const std::vector<std::size_t>& which);

  const std::string& text() const { return shader_.text; }
  std::size_t coefficient() const { return coefficient_; }  ///< the only one, of atlas and compute shaders
  /// Sets samplers and weights. @param weights  of all groups
  /// @param page  that is drawn; of no matter where textures are arrays
  void bind(const Program& program, int first_unit, const std::vector<Rgb>& weights, int page) const;

 private:
  void upload(const Context& context, const EncodedLayers& layers, const std::vector<std::size_t>& which);

  ComposedShader shader_;
  std::size_t coefficient_;
  std::vector<std::size_t> groups_;             ///< that the text calls 0, 1, ...
  std::vector<Rgb> colors_;                     ///< of these
  std::vector<std::vector<Texture>> textures_;  ///< per sampler: one, or one per page
};

/// Indices of textures, split so that each part's textures, array slices and weights are within the device's
/// limits, and no part holds two coefficients that the form must not mix.
/// @param form  functions allow for one part only
/// @throws Error where a single texture is beyond the limits
std::vector<std::vector<std::size_t>> split_layers(const Context& context, const EncodedLayers& layers,
                                                   const ShaderTier& tier, ShaderSpec::Form form);
std::vector<LayerPass> make_passes(const Context& context, const EncodedLayers& layers,
                                   const ShaderTier& tier, ShaderSpec::Form form);

}  // namespace sconce::gpu
