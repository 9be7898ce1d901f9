// SPDX-License-Identifier: Apache-2.0
// The only translation unit with stb_image_write's implementation; its symbols stay inside.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "core/error.h"
#include "core/files.h"
#include "image/io.h"

namespace sconce {

std::vector<unsigned char> encode_png(const Image8& image) {
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  if (image.width < 1 || image.height < 1 || image.channels < 1 || image.channels > 4 ||
      image.data.size() != row * static_cast<std::size_t>(image.height))
    throw Error({}, "picture cannot be encoded: its data does not match its size");
  std::vector<unsigned char> png;
  const auto append = [](void* to, void* data, int size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    static_cast<std::vector<unsigned char>*>(to)->assign(bytes, bytes + size);
  };
  if (stbi_write_png_to_func(append, &png, image.width, image.height, image.channels, image.data.data(),
                             static_cast<int>(row)) == 0)
    throw Error({}, "picture cannot be encoded: out of memory");
  return png;
}

void write_png(const std::filesystem::path& path, const Image8& image) {
  const std::vector<unsigned char> png = encode_png(image);
  write_file(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace sconce
