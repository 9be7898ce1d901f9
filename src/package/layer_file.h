// SPDX-License-Identifier: Apache-2.0
// Encoded layers as files: floats as OpenEXR, everything else as KTX2 (docs/package-format.md, "Layers").
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "encode/encoding.h"

namespace sconce {

/// ".exr" or ".ktx2".
std::string_view layer_extension(const Encoding& encoding);

/// @param channels  names of the image's channels
/// @param text      attributes; `sconce:unit` is added
/// @throws Error
void write_layer_file(const std::filesystem::path& path, const EncodedImage& layer,
                      const std::vector<std::string>& channels, std::map<std::string, std::string> text);

/// What the manifest says of a layer file.
struct LayerShape {
  const Encoding* encoding;
  int width, height;
  std::vector<std::string> channels;
  std::array<float, 4> gain;
};
/// @throws Error naming the file where it is damaged or says something else
EncodedImage read_layer_file(const std::filesystem::path& path, const LayerShape& shape);

/// The named channels of an image file, in this order. @throws Error naming the file and what it lacks
Image pick_channels(const Image& image, const std::vector<std::string>& names, int width, int height,
                    const std::filesystem::path& file);

}  // namespace sconce
