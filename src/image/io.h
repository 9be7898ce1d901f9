// SPDX-License-Identifier: Apache-2.0
// Reading and writing images. This module is the only place that names OpenEXR and stb_image.
#pragma once

#include <filesystem>
#include <span>

#include "image/image.h"

namespace sconce {

enum class PixelType { half, full };

/// The data window of the first part: all channels as float (uint above 2^24 rounded), level 0 of tiled
/// files. Layers in file order (by name), inside a layer R, G, B, A first and in this order. Luminance-chroma
/// files become R, G, B(, A). NaN and infinities pass through. String and float attributes and the primaries
/// are kept.
/// @throws Error (damaged, deep, no such file), NotMyFormat (no EXR)
Image read_exr(const std::filesystem::path& path);

/// ZIP-compressed scanlines with the image's chromaticities; written beside, then renamed. Halves are rounded
/// to nearest even, finite values beyond +-65504 become +-65504. @throws Error (also when the disk is full;
/// nothing is left behind)
void write_exr(const std::filesystem::path& path, const Image& image, PixelType type);

/// PNG, JPEG, BMP, TGA (8-bit as stored), from memory; `channels` 1 to 4 converts, 0 keeps. @throws
/// NotMyFormat, Error
Image8 decode_image8(std::span<const unsigned char> bytes, const std::string& where, int channels = 0);

/// Radiance .hdr file: RGB float in the file's own radiance unit (stored values / EXPOSURE). @throws
/// NotMyFormat, Error
Image read_hdr(const std::filesystem::path& path);

/// .exr, .hdr or an 8-bit picture decoded from sRGB to linear, by content. R, G, B come in Rec. 709 whatever
/// primaries the file names. @throws Error
Image read_image(const std::filesystem::path& path);

/// PNG as bytes, and to a file (beside, then renamed).
std::vector<unsigned char> encode_png(const Image8& image);
void write_png(const std::filesystem::path& path, const Image8& image);

}  // namespace sconce
