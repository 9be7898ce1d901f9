// SPDX-License-Identifier: Apache-2.0
// The product of wavelet rows and light, compiled for every vector unit that the machine may have.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transfer/multiply.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each target
#include <hwy/highway.h>

#include "core/parallel.h"
#include "transfer/quantise.h"
#include "transfer/wavelet_rows.h"

HWY_BEFORE_NAMESPACE();
namespace sconce {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One block: sums of 16 rows in registers, three channels.
void multiply_block(const WaveletRows& rows, std::size_t block, const Rgbx* light, Rgb* out) {
  constexpr std::size_t kBlock = WaveletRows::kBlock;
  const hn::CappedTag<float, kBlock> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d), kParts = kBlock / kLanes;
  const hn::Rebind<int32_t, decltype(d)> d32;
  const hn::Rebind<int8_t, decltype(d)> d8;
  using V = hn::Vec<decltype(d)>;
  V red[kParts], green[kParts], blue[kParts];
  for (std::size_t p = 0; p < kParts; ++p) red[p] = green[p] = blue[p] = hn::Zero(d);
  const uint32_t end = rows.first[block + 1];
  const int8_t* codes = rows.codes.data() + kBlock * rows.first[block];
  for (uint32_t k = rows.first[block]; k < end; ++k, codes += kBlock) {
    const Rgbx& l = light[rows.indices[k]];
    const V r = hn::Set(d, l[0]), g = hn::Set(d, l[1]), b = hn::Set(d, l[2]);
    for (std::size_t p = 0; p < kParts; ++p) {
      const V code = hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(d8, codes + p * kLanes)));
      const V value = hn::Mul(code, hn::Abs(code));
      red[p] = hn::MulAdd(value, r, red[p]);
      green[p] = hn::MulAdd(value, g, green[p]);
      blue[p] = hn::MulAdd(value, b, blue[p]);
    }
  }
  alignas(64) float sums[3][kBlock];
  for (std::size_t p = 0; p < kParts; ++p) {
    hn::StoreU(red[p], d, sums[0] + p * kLanes);
    hn::StoreU(green[p], d, sums[1] + p * kLanes);
    hn::StoreU(blue[p], d, sums[2] + p * kLanes);
  }
  const std::size_t count = std::min<std::size_t>(kBlock, rows.rows - kBlock * block);
  for (std::size_t r = 0; r < count; ++r) {
    const float scale = rows.scales[kBlock * block + r] / (kMostCode * kMostCode);
    const float mean = rows.means[kBlock * block + r];
    out[r] = Rgb(scale * sums[0][r] + mean * light[0][0], scale * sums[1][r] + mean * light[0][1],
                 scale * sums[2][r] + mean * light[0][2]);
  }
}

void multiply_blocks(const WaveletRows& rows, std::size_t first, std::size_t end, const Rgbx* light,
                     Rgb* out) {
  for (std::size_t block = first; block < end; ++block)
    multiply_block(rows, block, light, out + WaveletRows::kBlock * block);
}

}  // namespace HWY_NAMESPACE
}  // namespace sconce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sconce {

HWY_EXPORT(multiply_blocks);

void multiply(const WaveletRows& rows, std::span<const Rgbx> light, std::span<Rgb> out) {
  constexpr std::size_t kGrain = 256;
  parallel_for((rows.blocks() + kGrain - 1) / kGrain, 1, [&](std::size_t part) {
    HWY_DYNAMIC_DISPATCH(multiply_blocks)
    (rows, part * kGrain, std::min(rows.blocks(), (part + 1) * kGrain), light.data(), out.data());
  });
}

}  // namespace sconce
#endif
