// SPDX-License-Identifier: Apache-2.0
// Layers in memory as they are stored: what the software mix sums and what a GPU takes.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "package/package.h"

namespace sconce {

struct EncodedLayers {
  std::vector<LayerTexture> textures;             ///< with gains
  std::vector<std::vector<EncodedImage>> images;  ///< [texture][page], all of one size
  std::vector<Rgb> colors;  ///< per group: its own of luminance 1 where its luminance is packed, else 1

  int width() const { return images.front().front().width; }
  int height() const { return images.front().front().height; }
  int pages() const { return static_cast<int>(images.front().size()); }
  /// Of the basis, that there are textures of.
  std::size_t coefficients() const { return textures.back().coefficient + 1; }
  /// A group's layer, decoded: RGB, per page. @pre there is such a group
  std::vector<Image> layer(std::size_t group) const;
  /// The same to rounding, by vectors and all threads, into what an earlier call has left.
  void layer(std::size_t group, std::vector<Image>& pages) const;
  /// Codes of all pages.
  std::size_t bytes() const;
};

/// The member `layers` of what is shared, which it keeps.
template <class Owner>
std::shared_ptr<const EncodedLayers> layers_of(const std::shared_ptr<Owner>& owner) {
  return {owner, &owner->layers};
}

/// @param coefficients  of the basis: the first alone, or all, one after the other
/// @throws as Package::encoded
EncodedLayers read_layers(const Package& package, std::size_t coefficients = 1);

/// Layers that are in no package.
/// @param choices  per group
/// @param colors   per group, of luminance 1; used where luminance is packed
/// @param layer    RGB lux of a group on a page
EncodedLayers encode_layers(const std::vector<EncodingChoice>& choices, int pages,
                            const std::vector<Rgb>& colors,
                            const std::function<Image(std::size_t group, int page)>& layer);

}  // namespace sconce
