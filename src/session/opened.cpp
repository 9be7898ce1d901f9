// SPDX-License-Identifier: Apache-2.0
#include "session/opened.h"

#include <cmath>

namespace sconce {

Opened::Opened(Package opened)
    : package(std::move(opened)),
      rays(package),
      layers(read_layers(package, rays.sees_normal_maps() ? coefficients(Basis::sh1) : 1)),
      meter(package, rays.scene()),
      planes(baked_planes(package)),
      probes(read_probes(package)) {}

std::vector<Image> mixed_noise(const Opened& opened, const MixSpec& mix) {
  const Manifest& m = opened.package.manifest();
  std::vector<Image> pages;
  for (int page = 0; page < m.pages; ++page) {
    const Image noise = opened.package.noise(page);
    Image& out = pages.emplace_back(Image::rgb(m.width, m.height));
    std::vector<float> squares(out.pixels()), sums(out.pixels());
    for (std::size_t g = 0; g < m.groups.size(); ++g) {
      if (mix.weights.at(g).is_black()) continue;
      const Image layer = opened.package.layer(g, page);
      for (std::size_t i = 0; i < out.pixels(); ++i) {
        const float* e = &layer.data[i * layer.stride()];
        const float lux = luminance(mix.weights[g] * Rgb(e[0], e[1], e[2]));
        const float error = lux * noise.data[i * noise.stride() + g];
        squares[i] += error * error;
        sums[i] += lux;
      }
    }
    for (std::size_t i = 0; i < out.pixels(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        out.data[3 * i + c] = sums[i] > 0 ? 100 * std::sqrt(squares[i]) / sums[i] : 0;
  }
  return pages;
}

}  // namespace sconce
