// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <algorithm>

namespace sconce {

int Image::channel(std::string_view name) const {
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i] == name) return static_cast<int>(i);
  return -1;
}

Image rgb_of(const Image& image) {
  const auto channel = [&](const char* name, int otherwise) {
    const int found = image.channel(name);
    return found >= 0 ? found : std::min(otherwise, static_cast<int>(image.stride()) - 1);
  };
  const int grey = image.channel("Y");
  const int from[3] = {grey >= 0 ? grey : channel("R", 0), grey >= 0 ? grey : channel("G", 1),
                       grey >= 0 ? grey : channel("B", 2)};
  Image out = Image::rgb(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.at(x, y);
      out.set_rgb(x, y, {p[from[0]], p[from[1]], p[from[2]]});
    }
  return out;
}

}  // namespace sconce
