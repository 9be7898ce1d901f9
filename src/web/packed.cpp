// SPDX-License-Identifier: Apache-2.0
#include "web/packed.h"

#include <zlib.h>

#include "core/error.h"

namespace sconce::web {

std::string pack(std::span<const std::byte> data, std::size_t element) {
  std::string sorted;
  sorted.reserve(data.size());
  for (std::size_t k = 0; k < element; ++k) {
    unsigned char last = 0;
    for (std::size_t i = k; i < data.size(); i += element) {
      const auto byte = static_cast<unsigned char>(data[i]);
      sorted += static_cast<char>(static_cast<unsigned char>(byte - last));
      last = byte;
    }
  }
  uLongf size = compressBound(sorted.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(sorted.data()),
                sorted.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw Error({}, "out of memory while compressing");
  packed.resize(size);
  return packed;
}

}  // namespace sconce::web
