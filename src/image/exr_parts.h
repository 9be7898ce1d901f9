// SPDX-License-Identifier: Apache-2.0
// A renderer's whole OpenEXR file: every part and channel, to change some and keep the rest.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"

namespace sconce {

/// Attributes of the file, held for its copy.
struct ExrAttributes;

/// Pixels from `x`, `y` on, downwards.
struct ExrWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

struct ExrParts {
  /// All parts over the box of their data windows, 0 where a part has no pixel. A channel of several parts'
  /// files is called PART.CHANNEL where its name does not begin so. Integers are kept as their bits.
  Image image;
  std::vector<bool> integer;          ///< per channel
  ExrWindow data, display;            ///< data: of the image
  std::vector<std::string> left_out;  ///< deep parts, subsampled channels, second channels of a name
  std::shared_ptr<const ExrAttributes> attributes;  ///< of the first part; may be null
};

/// @throws Error (damaged, no such file), NotMyFormat (no EXR)
ExrParts read_exr_parts(const std::filesystem::path& path);

/// One part of ZIP-compressed float (or integer) scanlines, with the windows and attributes that were read;
/// written beside, then renamed. @throws Error
void write_exr_parts(const std::filesystem::path& path, const ExrParts& picture);

}  // namespace sconce
