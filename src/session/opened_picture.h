// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mix/encoded_layers.h"
#include "mix/layered_image.h"
#include "session/goals.h"

namespace sconce {

/// Another renderer's picture with light groups, made ready for faders: each group, `rest` too, is a layer of
/// one page, in floats, Rec. 709, over the display window.
struct OpenedPicture {
  /// @param groups_from  see find_layers() @throws Error naming the file: damaged, or without light groups
  OpenedPicture(const std::filesystem::path& path, const std::string& groups_from);

  LayeredImage picture;
  EncodedLayers layers;
  std::vector<float> means;  ///< of each group: mean luminance over the display window

  int width() const { return layers.width(); }
  int height() const { return layers.height(); }
};

/// What there is at a pixel of the mix, in the picture's own unit.
struct PictureReading {
  Rgb value;
  std::vector<float> groups;  ///< luminance of each group, weighted
};
/// @param at  in pixels from the top left, inside the picture
PictureReading read_pixel(const OpenedPicture& opened, const MixSpec& mix, Vec2 at);

/// As wish_picture() of a package: what is wished for is a picture of the same view.
/// @throws Error where the target has no R, G and B, is black, or has another shape
void wish_picture(Wishes& wishes, const OpenedPicture& opened, std::span<const Rgb> unit,
                  const Image& target);

}  // namespace sconce
