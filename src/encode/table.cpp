// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "encode/rows.h"

namespace sconce {

std::span<const Encoding> encodings() {
  static const std::array kTable{kEncodingF32, kEncodingF16};
  return kTable;
}

const Encoding& find_encoding(std::string_view name) {
  std::vector<std::string> names;
  for (const Encoding& encoding : encodings()) {
    if (encoding.name == name) return encoding;
    names.emplace_back(encoding.name);
  }
  throw UsageError({}, "unknown encoding '" + std::string(name) + "'", join(names, ", "));
}

Image round_trip(const Image& image, const Encoding& encoding) {
  if (image.data.size() % 3 != 0) throw Error({}, "encodings need channels in threes");
  std::vector<std::byte> texels(image.data.size() / 3 * encoding.bytes_per_texel);
  Image out = image;
  encoding.encode(image.data, texels);
  encoding.decode(texels, out.data);
  return out;
}

}  // namespace sconce
