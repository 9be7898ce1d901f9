// SPDX-License-Identifier: Apache-2.0
#include "image/webp.h"

#include <webp/decode.h>
#include <webp/encode.h>

#include <cstring>
#include <memory>

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

std::vector<unsigned char> encode_webp(const Image8& image) {
  if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) return {};
  constexpr int kEffort = 6;  // of 9, which takes fifty times as long for a few percent
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigInit(&config) == 0 || WebPConfigLosslessPreset(&config, kEffort) == 0 ||
      WebPPictureInit(&picture) == 0)
    throw Error({}, "libwebp is of another version");
  config.exact = 1;
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> frees_picture(&picture, WebPPictureFree);
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<unsigned char> rgba;
  for (std::size_t i = 0; i < image.data.size(); i += channels)
    for (std::size_t c = 0; c < 4; ++c)
      rgba.push_back(c < 3               ? image.data[i + (channels < 3 ? 0 : c)]
                     : channels % 2 == 0 ? image.data[i + channels - 1]
                                         : 255);
  WebPMemoryWriter written;
  WebPMemoryWriterInit(&written);
  const std::unique_ptr<WebPMemoryWriter, void (*)(WebPMemoryWriter*)> frees_bytes(&written,
                                                                                   WebPMemoryWriterClear);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &written;
  if (WebPPictureImportRGBA(&picture, rgba.data(), 4 * image.width) == 0 ||
      WebPEncode(&config, &picture) == 0)
    throw Error({}, "out of memory while compressing a picture");
  return {written.mem, written.mem + written.size};
}

}  // namespace sconce
