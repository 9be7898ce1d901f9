// SPDX-License-Identifier: Apache-2.0
#include "image/webp.h"

#include <webp/decode.h>

#include <cstring>

#include "core/error.h"

namespace sconce {

bool is_webp(std::span<const unsigned char> bytes) {
  return bytes.size() > 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

Image8 decode_webp(std::span<const unsigned char> bytes, const std::string& where) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
    throw Error(where, "damaged WebP picture");
  Image8 out{features.width, features.height, features.has_alpha != 0 ? 4 : 3, {}};
  const int row = out.width * out.channels;
  out.data.resize(static_cast<std::size_t>(row) * static_cast<std::size_t>(out.height));
  const auto decode = out.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (decode(bytes.data(), bytes.size(), out.data.data(), out.data.size(), row) == nullptr)
    throw Error(where, "damaged WebP picture");
  return out;
}

}  // namespace sconce
