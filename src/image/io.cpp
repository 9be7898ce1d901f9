// SPDX-License-Identifier: Apache-2.0
#include "image/io.h"

#include "core/error.h"
#include "core/files.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/ldr.h"
#include "image/primaries.h"

namespace sconce {

Image read_image(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  if (is_exr(bytes)) {
    Image image = decode_exr(bytes, path.string());
    to_rec709(image);
    return image;
  }
  const std::span<const unsigned char> data(reinterpret_cast<const unsigned char*>(bytes.data()),
                                            bytes.size());
  if (bytes.starts_with("#?")) {
    Image image = decode_hdr(data, path.string());
    to_rec709(image);
    return image;
  }
  try {
    return decode_linear(data, path.string());
  } catch (const NotMyFormat&) {
    throw Error(path.string(), "is not a picture", "OpenEXR, Radiance HDR, PNG, JPEG, BMP, TGA");
  }
}

}  // namespace sconce
