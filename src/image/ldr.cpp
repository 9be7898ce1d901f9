// SPDX-License-Identifier: Apache-2.0
// The only translation unit with stb_image's implementation; its symbols stay inside.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_GIF
#define STBI_NO_PSD
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb/stb_image.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "image/io.h"
#include "image/ldr.h"

namespace sconce {

namespace {

struct StbFree {
  void operator()(void* p) const { stbi_image_free(p); }
};
template <class T>
using StbPixels = std::unique_ptr<T, StbFree>;

bool starts_with(std::span<const unsigned char> bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

/// Size and channels of an 8- or 16-bit picture. TGA has no magic number; whatever else stb takes for one is
/// refused.
Image8 picture_header(std::span<const unsigned char> bytes, const std::string& where) {
  const bool known =
      starts_with(bytes, "\x89PNG") || starts_with(bytes, "\xff\xd8\xff") || starts_with(bytes, "BM");
  Image8 header;
  const bool ok = bytes.size() < (1u << 31) &&
                  stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &header.width,
                                        &header.height, &header.channels) != 0;
  if (!ok && !known) throw NotMyFormat(where, "is not a picture", "PNG, JPEG, BMP, TGA");
  if (!ok) throw Error(where, std::string("damaged picture: ") + stbi_failure_reason());
  // Deflate reaches 1:1032; a JPEG of one colour and run-length TGA stay below.
  const double claimed = 1.0 * header.width * header.height * header.channels;
  if (claimed > 64e6 + 2048.0 * static_cast<double>(bytes.size()))
    throw Error(where, "damaged picture: claims more pixels than its bytes can hold");
  return header;
}

}  // namespace

Image8 decode_image8(std::span<const unsigned char> bytes, const std::string& where, int channels) {
  Image8 image = picture_header(bytes, where);
  const StbPixels<unsigned char> pixels(stbi_load_from_memory(
      bytes.data(), static_cast<int>(bytes.size()), &image.width, &image.height, &image.channels, channels));
  if (!pixels) throw Error(where, std::string("damaged picture: ") + stbi_failure_reason());
  if (channels != 0) image.channels = channels;
  image.data.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(image.width) *
                                                     static_cast<std::size_t>(image.height) *
                                                     static_cast<std::size_t>(image.channels));
  return image;
}

Image decode_linear(std::span<const unsigned char> bytes, const std::string& where) {
  picture_header(bytes, where);
  int width = 0, height = 0, stored = 0;
  // stb widens 8 bits to 16 by v * 257, so one path is exact for both depths.
  const StbPixels<unsigned short> pixels(
      stbi_load_16_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &stored, 4));
  if (!pixels) throw Error(where, std::string("damaged picture: ") + stbi_failure_reason());
  const bool alpha = stored == 2 || stored == 4;
  Image image(width, height, {"R", "G", "B"});
  if (alpha) image = Image(width, height, {"R", "G", "B", "A"});
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const unsigned short* from = pixels.get() + 4 * i;
    float* to = &image.data[i * image.stride()];
    for (int c = 0; c < 3; ++c) to[c] = srgb_to_linear(static_cast<float>(from[c]) / 65535.0f);
    if (alpha) to[3] = static_cast<float>(from[3]) / 65535.0f;
  }
  return image;
}

}  // namespace sconce
