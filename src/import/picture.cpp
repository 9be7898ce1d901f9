// SPDX-License-Identifier: Apache-2.0
#include "import/picture.h"

#include <cstring>

#include "core/error.h"
#include "image/io.h"
#include "image/webp.h"
#include "import/uri.h"

namespace sconce {

namespace {

bool is_ktx2(std::span<const unsigned char> file) {
  constexpr std::string_view kMagic = "\xabKTX 20\xbb\r\n\x1a\n";
  return file.size() > kMagic.size() && std::memcmp(file.data(), kMagic.data(), kMagic.size()) == 0;
}

}  // namespace

Image8 decode_texture(std::span<const unsigned char> file, const std::string& where) {
  if (is_lfs_pointer({reinterpret_cast<const char*>(file.data()), file.size()}))
    throw Error(where, "only its Git LFS pointer is there");
  if (is_ktx2(file))
    throw Error(where, "is a KTX2 picture; KTX-Software's `ktx extract` makes a PNG of it",
                "PNG, JPEG, WebP");
  Image8 stored = is_webp(file) ? decode_webp(file, where) : decode_image8(file, where);
  if (stored.channels >= 3) return stored;
  Image8 out{stored.width, stored.height, stored.channels + 2, {}};
  out.data.reserve(stored.data.size() / static_cast<std::size_t>(stored.channels) *
                   static_cast<std::size_t>(out.channels));
  const auto step = static_cast<std::size_t>(stored.channels);
  for (std::size_t i = 0; i + step <= stored.data.size(); i += step) {
    for (int c = 0; c < 3; ++c) out.data.push_back(stored.data[i]);
    if (step == 2) out.data.push_back(stored.data[i + 1]);
  }
  return out;
}

std::string picture_mime(std::span<const unsigned char> file) {
  if (file.size() > 8 && file[0] == 0x89 && file[1] == 'P' && file[2] == 'N' && file[3] == 'G')
    return "image/png";
  if (file.size() > 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff) return "image/jpeg";
  return {};
}

}  // namespace sconce
