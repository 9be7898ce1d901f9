// SPDX-License-Identifier: Apache-2.0
#include "picture/fixed_function.h"

#include "core/parallel.h"
#include "encode/half.h"
#include "picture/seen.h"
#include "tone/apply.h"

namespace sconce {

namespace {

/// The code that a texture of albedo holds.
float albedo_code(uint16_t over_pi) {
  const float albedo = std::min(half_to_float(over_pi) * kPi, 1.0f);
  return std::floor(linear_to_srgb(albedo) * 255.0f + 0.5f) / 255.0f;
}

Rgb modulated(const CameraHits::Pixel& pixel, const Image8& lightmap) {
  const auto right = static_cast<std::size_t>(lightmap.width > 1 ? 3 : 0);
  const auto below = static_cast<std::size_t>(lightmap.height > 1 ? 3 * lightmap.width : 0);
  const float x = static_cast<float>(pixel.place[0]) / CameraHits::kWhole,
              y = static_cast<float>(pixel.place[1]) / CameraHits::kWhole;
  const auto channel = [&](std::size_t c) {
    const unsigned char* t = &lightmap.data[3 * std::size_t{pixel.texel} + c];
    const float top = (1 - x) * t[0] + x * t[right], bottom = (1 - x) * t[below] + x * t[below + right];
    return albedo_code(pixel.albedo[c]) * ((1 - y) * top + y * bottom) / 255.0f;
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

Image fixed_function(const CameraHits& hits, const MixSpec& mix, const std::vector<Image8>& lightmap,
                     const Exposure& exposure, const ToneMapper& mapper) {
  check_fits(hits, mix, lightmap);
  Image picture = Image::rgb(hits.width, hits.height);
  parallel_for(static_cast<std::size_t>(hits.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<Rgb> shine(static_cast<std::size_t>(hits.width));
    hits.for_each_shine(
        y, [&](const CameraHits::Shine& s) { shine[s.x] += weight_of(mix, s.group) * s.radiance; });
    for (int x = 0; x < hits.width; ++x) {
      const CameraHits::Pixel& pixel = hits.row(y)[static_cast<std::size_t>(x)];
      Rgb c = modulated(pixel, lightmap[pixel.page]);
      if (const Rgb& s = shine[static_cast<std::size_t>(x)]; !s.is_black())
        c += tone_map(s, exposure, mapper);
      picture.set_rgb(x, y, {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)});
    }
  });
  return picture;
}

}  // namespace sconce
