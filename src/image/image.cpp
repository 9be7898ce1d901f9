// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

namespace sconce {

int Image::channel(std::string_view name) const {
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i] == name) return static_cast<int>(i);
  return -1;
}

}  // namespace sconce
