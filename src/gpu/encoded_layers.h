// SPDX-License-Identifier: Apache-2.0
// A package's layers as they are stored, ready to be uploaded.
#pragma once

#include <vector>

#include "gpu/context.h"
#include "package/package.h"
#include "shader/composer.h"

namespace sconce::gpu {

struct EncodedLayers {
  std::vector<LayerTexture> textures;             ///< with gains
  std::vector<std::vector<EncodedImage>> images;  ///< [texture][page], all of one size
  std::vector<Rgb> colors;  ///< per group: its own of luminance 1 where its luminance is packed, else 1

  int width() const { return images.front().front().width; }
  int height() const { return images.front().front().height; }
  int pages() const { return static_cast<int>(images.front().size()); }
  /// As uploaded: codes of all pages.
  std::size_t bytes() const;
};

/// @throws Error as Package::encoded, or when there are no layers
EncodedLayers read_layers(const Package& package);

/// Layers of which this tier has no textures are encoded anew (tier_encoding).
EncodedLayers for_tier(EncodedLayers layers, const ShaderTier& tier);

/// The best tier of all that the device has.
const ShaderTier& tier_of(const Capabilities& can);

}  // namespace sconce::gpu
