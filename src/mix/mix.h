// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mix/settings.h"

namespace sconce {

/// sum_g w_g * E_g of one page, RGB lux, or of another coefficient of the basis. Layers with weight 0 are not
/// read.
Image mix_page(const Package& package, const MixSpec& mix, int page, std::size_t coefficient = 0);
std::vector<Image> mix_pages(const Package& package, const MixSpec& mix);
/// The vectors g of a mix, one image per axis: [3 * page + axis]. Empty where the basis is flat.
std::vector<Image> mix_components(const Package& package, const MixSpec& mix);
/// @throws Error when the mix or its pages are of another package
void check_pages(const Manifest& manifest, const MixSpec& mix, std::span<const Image> pages);

/// Whether a texel says how bright its surface looks. Where nothing is reflected diffusely it does not:
/// mirrors and metals show others.
inline bool is_metered(const Rgb& albedo, float weight) {
  return weight > 0 && !albedo.is_black();
}
/// What automatic exposure and the curves that need it are metered on: the mixed lightmap, never the picture,
/// so that CPU, GL and web agree and orbiting does not flicker (contract.md, "Exposure").
struct Metering {
  double log_mean =
      0;               ///< exp of the weighted mean of ln(L + 1e-4), L = luminance of rho/pi * sum w E, cd/m2
  double maximum = 0;  ///< weighted 99.9th percentile of L, visible emitters included, cd/m2
  double bright = 0;   ///< weighted 80th percentile of L, without emitters, cd/m2
};
/// @param scene  package.scene(): its emitters count for the maximum, by area, with emission at triangle
/// centres
/// @param mixed  the pages of mix_pages()
Metering meter(const Package& package, const Scene& scene, const MixSpec& mix, std::span<const Image> mixed);
/// The same; reads the scene itself.
Metering meter(const Package& package, const MixSpec& mix, std::span<const Image> mixed);
/// Of a picture in cd/m2 that no lightmap stands behind.
Metering meter_picture(const Image& picture);

}  // namespace sconce
