// SPDX-License-Identifier: Apache-2.0
#include "mix/mix.h"

#include "core/error.h"
#include "core/parallel.h"
#include "mix/accumulate.h"

namespace sconce {

void accumulate(Image& sum, const Rgb& weight, const Image& layer, std::span<const std::size_t, 3> channels) {
  const auto width = static_cast<std::size_t>(sum.width);
  parallel_for(static_cast<std::size_t>(sum.height), 16, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const float* e = &layer.data[i * layer.stride()];
      float* out = &sum.data[i * 3];
      out[0] += weight.r * e[channels[0]];
      out[1] += weight.g * e[channels[1]];
      out[2] += weight.b * e[channels[2]];
    }
  });
}

Image mix_page(const Package& package, const MixSpec& mix, int page, std::size_t coefficient) {
  const Manifest& m = package.manifest();
  if (mix.weights.size() != m.groups.size())
    throw Error(package.path().string(), "the mix has another number of groups than the package");
  Image sum = Image::rgb(m.width, m.height);
  sum.text["sconce:unit"] = "lux";
  for (std::size_t g = 0; g < m.groups.size(); ++g)
    if (!mix.weights[g].is_black())
      accumulate(sum, mix.weights[g], package.layer(g, page, coefficient),
                 std::array<std::size_t, 3>{0, 1, 2});
  return sum;
}

std::vector<Image> mix_pages(const Package& package, const MixSpec& mix) {
  std::vector<Image> pages;
  for (int page = 0; page < package.manifest().pages; ++page) pages.push_back(mix_page(package, mix, page));
  return pages;
}

std::vector<Image> mix_components(const Package& package, const MixSpec& mix) {
  std::vector<Image> components;
  for (int page = 0; page < package.manifest().pages; ++page)
    for (std::size_t c = 1; c < coefficients(package.manifest().basis); ++c)
      components.push_back(mix_page(package, mix, page, c));
  return components;
}

void check_pages(const Manifest& m, const MixSpec& mix, std::span<const Image> pages) {
  bool fits = mix.weights.size() == m.groups.size() && pages.size() == static_cast<std::size_t>(m.pages);
  for (const Image& page : pages)
    fits = fits && page.width == m.width && page.height == m.height && page.stride() == 3;
  if (!fits) throw Error({}, "the mix does not belong to this package");
}

}  // namespace sconce
