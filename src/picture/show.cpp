// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set (Highway's foreach_target); the best one that the processor has is
// called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "picture/show.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.
#include <hwy/highway.h>

#include "core/error.h"
#include "core/parallel.h"
#include "encode/half.h"
#include "picture/seen.h"
#include "picture/show.h"

HWY_BEFORE_NAMESPACE();
namespace sconce::HWY_NAMESPACE {

namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void shade(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb) {
  shade_row_plain(hits, y, pages, rgb);
}
#else
/// One pixel at a time: its texels lie anywhere, but a texel's channels lie together.
using Four = hn::FixedTag<float, 4>;
using V = hn::Vec<Four>;

/// Between two neighbours: R0 G0 B0 R1 and B0 R1 G1 B1 are read, nothing behind them.
inline V between(const float* texels, V place) {
  const Four d;
  const V left = hn::LoadU(d, texels), right = hn::Shuffle0321(hn::LoadU(d, texels + 2));
  return hn::MulAdd(place, hn::Sub(right, left), left);
}

/// @pre pages of 2 x 2 texels or more
void shade(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb) {
  const Four d;
  const hn::Rebind<hwy::float16_t, Four> halves;
  constexpr float kUnit = 1.0f / CameraHits::kWhole;
  const std::size_t below = 3 * static_cast<std::size_t>(hits.page_width);
  std::vector<const float*> first;
  for (const Image& page : pages) first.push_back(page.data.data());
  for (const CameraHits::Pixel& p : hits.row(y)) {
    const float* texels = first[p.page] + 3 * std::size_t{p.texel};
    const V at_x = hn::Set(d, static_cast<float>(p.place[0]) * kUnit);
    const V at_y = hn::Set(d, static_cast<float>(p.place[1]) * kUnit);
    const V top = between(texels, at_x), bottom = between(texels + below, at_x);
    const V light = hn::MulAdd(at_y, hn::Sub(bottom, top), top);
    // The fourth is the page.
    const V albedo =
        hn::PromoteTo(d, hn::LoadU(halves, reinterpret_cast<const hwy::float16_t*>(p.albedo.data())));
    hn::StoreU(hn::Mul(light, albedo), d, rgb);
    rgb += 3;
  }
}
#endif

}  // namespace
}  // namespace sconce::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sconce {

HWY_EXPORT(shade);

void shade_row_plain(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb) {
  const auto right = static_cast<std::size_t>(hits.page_width > 1 ? 1 : 0);
  const auto below = static_cast<std::size_t>(hits.page_height > 1 ? hits.page_width : 0);
  for (const CameraHits::Pixel& p : hits.row(y)) {
    const float wx = static_cast<float>(p.place[0]) / CameraHits::kWhole,
                wy = static_cast<float>(p.place[1]) / CameraHits::kWhole;
    for (std::size_t c = 0; c < 3; ++c) {
      const float* e = &pages[p.page].data[3 * std::size_t{p.texel} + c];
      const float top = (1 - wx) * e[0] + wx * e[3 * right];
      const float bottom = (1 - wx) * e[3 * below] + wx * e[3 * (below + right)];
      *rgb++ = half_to_float(p.albedo[c]) * ((1 - wy) * top + wy * bottom);
    }
  }
}

void shade_row(const CameraHits& hits, int y, const std::vector<Image>& pages, float* rgb) {
  if (hits.page_width < 2 || hits.page_height < 2) return shade_row_plain(hits, y, pages, rgb);
  HWY_DYNAMIC_DISPATCH(shade)(hits, y, pages, rgb);
}

Image8 show(const CameraHits& hits, const MixSpec& mix, const std::vector<Image>& pages,
            const ToneCodes& tone) {
  check_fits(hits, mix, pages);
  const auto width = static_cast<std::size_t>(hits.width);
  Image8 out{hits.width, hits.height, 3, std::vector<unsigned char>(3 * hits.pixels.size())};
  constexpr int kBand = 8;  // rows
  parallel_for(static_cast<std::size_t>((hits.height + kBand - 1) / kBand), 1, [&](std::size_t band) {
    std::vector<float> rgb(3 * width + 1);
    const int first = static_cast<int>(band) * kBand;
    for (int y = first; y < std::min(first + kBand, hits.height); ++y) {
      shade_row(hits, y, pages, rgb.data());
      hits.for_each_shine(y, [&](const CameraHits::Shine& shine) {
        const Rgb c = weight_of(mix, shine.group) * shine.radiance;
        float* to = &rgb[3 * std::size_t{shine.x}];
        to[0] += c.r, to[1] += c.g, to[2] += c.b;
      });
      tone.map(rgb.data(), width, &out.data[3 * static_cast<std::size_t>(y) * width]);
    }
  });
  return out;
}

}  // namespace sconce
#endif
