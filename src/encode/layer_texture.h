// SPDX-License-Identifier: Apache-2.0
// Which layers share a texture, as files, shaders and the software mix see it.
#pragma once

#include <string>
#include <vector>

#include "encode/basis.h"
#include "encode/choice.h"

namespace sconce {

/// One group, or up to four whose luminances are its channels.
struct LayerTexture {
  EncodingChoice encoding;
  std::vector<std::size_t> groups;
  std::vector<std::array<float, 4>> gain{};  ///< per page; where textures are read: EncodedImage::gain
  std::size_t coefficient = 0;               ///< of the basis

  /// @param names  of the groups; @return names of the channels: NAME.R, NAME.G, NAME.B or one NAME.Y per
  /// group
  std::vector<std::string> channels(const std::vector<std::string>& names) const;
  /// @param layers  RGB, one per group
  EncodedImage encode(const std::vector<const Image*>& layers) const;
  /// The RGB layer of the i-th of the groups. @param color  its group's, of luminance 1
  Image decode(const EncodedImage& texture, std::size_t i, const Rgb& color) const;
};

/// In the order of the groups; a luminance joins the last texture of its encoding that has room.
std::vector<LayerTexture> share_textures(const std::vector<EncodingChoice>& encodings);

}  // namespace sconce
