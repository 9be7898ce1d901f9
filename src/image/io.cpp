// SPDX-License-Identifier: Apache-2.0
#include "image/io.h"

#include "core/error.h"
#include "core/files.h"
#include "image/hdr.h"
#include "image/ldr.h"
#include "image/primaries.h"

namespace sconce {

Image read_image(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  if (bytes.compare(0, 4, "\x76\x2f\x31\x01", 4) == 0) {
    Image image = read_exr(path);
    to_rec709(image);
    return image;
  }
  const std::span<const unsigned char> data(reinterpret_cast<const unsigned char*>(bytes.data()),
                                            bytes.size());
  if (bytes.compare(0, 2, "#?") == 0) return decode_hdr(data, path.string());
  try {
    return decode_linear(data, path.string());
  } catch (const NotMyFormat&) {
    throw Error(path.string(), "is not a picture", "OpenEXR, Radiance HDR, PNG, JPEG, BMP, TGA");
  }
}

}  // namespace sconce
