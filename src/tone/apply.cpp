// SPDX-License-Identifier: Apache-2.0
#include "tone/apply.h"

#include "core/error.h"
#include "core/parallel.h"

namespace sconce {

Rgb tone_map(const Rgb& linear, const Exposure& exposure, const ToneMapper& mapper) {
  const Rgb c = mapper.map(linear * exposure.scale, exposure.params);
  return {linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b)};
}

Image8 tone_map(const Image& linear, const Exposure& exposure, const ToneMapper& mapper) {
  if (linear.stride() < 3) throw Error({}, "tone curves need a picture with R, G and B");
  Image8 out{linear.width, linear.height, 3, std::vector<unsigned char>(3 * linear.pixels())};
  const auto code = [](float v) { return static_cast<unsigned char>(v * 255.0f + 0.5f); };
  parallel_for(static_cast<std::size_t>(linear.height), 8, [&](std::size_t y) {
    unsigned char* to = &out.data[3 * y * static_cast<std::size_t>(linear.width)];
    for (int x = 0; x < linear.width; ++x, to += 3) {
      const Rgb c = tone_map(linear.rgb_at(x, static_cast<int>(y)), exposure, mapper);
      to[0] = code(c.r), to[1] = code(c.g), to[2] = code(c.b);
    }
  });
  return out;
}

}  // namespace sconce
