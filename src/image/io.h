// SPDX-License-Identifier: Apache-2.0
// Reading and writing images. With exr.cpp and ldr.cpp the only place that names OpenEXR and stb_image.
#pragma once

#include <filesystem>
#include <span>

#include "image/image.h"

namespace sconce {

enum class PixelType { half, full };

/// All channels of the first part as float, in file order. @throws Error (damaged), NotMyFormat (no EXR)
Image read_exr(const std::filesystem::path& path);

/// ZIP-compressed scanlines with Rec. 709 chromaticities; written beside, then renamed. @throws Error
void write_exr(const std::filesystem::path& path, const Image& image, PixelType type);

/// PNG, JPEG, BMP, TGA (8-bit as stored), from memory. @throws NotMyFormat, Error
Image8 decode_image8(std::span<const unsigned char> bytes, const std::string& where, int channels = 0);

/// Radiance .hdr from memory or a file, RGB float. @throws NotMyFormat, Error
Image read_hdr(const std::filesystem::path& path);

/// .exr, .hdr or an 8-bit picture decoded from sRGB to linear, by content. @throws Error
Image read_image(const std::filesystem::path& path);

/// PNG as bytes, and to a file (beside, then renamed).
std::vector<unsigned char> encode_png(const Image8& image);
void write_png(const std::filesystem::path& path, const Image8& image);

}  // namespace sconce
