// SPDX-License-Identifier: Apache-2.0
// Products of rows and light, compiled for every vector unit that the machine may have.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transfer/multiply.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each target
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "core/parallel.h"
#include "transfer/cluster_rows.h"
#include "transfer/quantise.h"

HWY_BEFORE_NAMESPACE();
namespace sconce {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One block: sums of 16 rows in registers, three channels.
/// @param entries  of its coefficients, or null for all
void multiply_block(const WaveletRows& rows, std::size_t block, const Rgbx* light,
                    const std::vector<uint32_t>* entries, Rgb* out) {
  constexpr std::size_t kBlock = WaveletRows::kBlock;
  const hn::CappedTag<float, kBlock> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d), kParts = kBlock / kLanes;
  const hn::Rebind<int32_t, decltype(d)> d32;
  const hn::Rebind<int8_t, decltype(d)> d8;
  using V = hn::Vec<decltype(d)>;
  V red[kParts], green[kParts], blue[kParts];
  for (std::size_t p = 0; p < kParts; ++p) red[p] = green[p] = blue[p] = hn::Zero(d);
  const auto add = [&](uint32_t k) HWY_ATTR {
    const int8_t* codes = rows.codes.data() + kBlock * std::size_t{k};
    const Rgbx& l = light[rows.indices[k]];
    const V r = hn::Set(d, l[0]), g = hn::Set(d, l[1]), b = hn::Set(d, l[2]);
    for (std::size_t p = 0; p < kParts; ++p) {
      const V code = hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(d8, codes + p * kLanes)));
      const V value = hn::Mul(code, hn::Abs(code));
      red[p] = hn::MulAdd(value, r, red[p]);
      green[p] = hn::MulAdd(value, g, green[p]);
      blue[p] = hn::MulAdd(value, b, blue[p]);
    }
  };
  if (entries != nullptr)
    for (const uint32_t k : *entries) add(k);
  else
    for (uint32_t k = rows.first[block]; k < rows.first[block + 1]; ++k) add(k);
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

/// @param lit  per coefficient of light: 1, or 0 to pass over it; null to look at all
void multiply_blocks(const WaveletRows& rows, std::size_t first, std::size_t end, const Rgbx* light,
                     const uint8_t* lit, Rgb* out) {
  std::vector<uint32_t> entries;
  for (std::size_t block = first; block < end; ++block) {
    if (lit != nullptr) {
      const uint32_t begin = rows.first[block], count = rows.first[block + 1] - begin;
      entries.resize(count);
      std::size_t kept = 0;
      for (uint32_t k = begin; k < begin + count; ++k) {  // no branch: it would be guessed wrong too often
        entries[kept] = k;
        kept += lit[rows.indices[k]];
      }
      entries.resize(kept);
    }
    multiply_block(rows, block, light, lit != nullptr ? &entries : nullptr,
                   out + WaveletRows::kBlock * block);
  }
}

/// Rows of a cluster out of the products of its basis, kLanes at a time.
/// @param sums  per basis row of all clusters
void combine_groups(const ClusterRows& rows, std::size_t first, std::size_t end, const Rgb* sums, Rgb* out) {
  constexpr std::size_t kRank = ClusterRows::kRank, kRows = ClusterRows::kLanes;
  const hn::CappedTag<float, kRows> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d), kParts = kRows / kLanes;
  const hn::Rebind<int32_t, decltype(d)> d32;
  const hn::Rebind<int16_t, decltype(d)> d16;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t group = first; group < end; ++group) {
    const std::size_t row = group * kRows;
    const Rgb* basis = sums + row / rows.cluster * kRank;
    const int16_t* weights = rows.weights.data() + group * kRank * kRows;
    V red[kParts], green[kParts], blue[kParts];
    for (std::size_t p = 0; p < kParts; ++p) red[p] = green[p] = blue[p] = hn::Zero(d);
    for (std::size_t j = 0; j < kRank; ++j, weights += kRows) {
      const V r = hn::Set(d, basis[j].r), g = hn::Set(d, basis[j].g), b = hn::Set(d, basis[j].b);
      for (std::size_t p = 0; p < kParts; ++p) {
        const V w = hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(d16, weights + p * kLanes)));
        red[p] = hn::MulAdd(w, r, red[p]);
        green[p] = hn::MulAdd(w, g, green[p]);
        blue[p] = hn::MulAdd(w, b, blue[p]);
      }
    }
    alignas(64) float whole[3 * kRows];
    for (std::size_t p = 0; p < kParts; ++p) {
      const V scale = hn::LoadU(d, rows.scales.data() + row + p * kLanes);
      hn::StoreInterleaved3(hn::Mul(scale, red[p]), hn::Mul(scale, green[p]), hn::Mul(scale, blue[p]), d,
                            whole + 3 * p * kLanes);
    }
    std::memcpy(static_cast<void*>(out + row), whole,
                sizeof(Rgb) * std::min<std::size_t>(kRows, rows.rows - row));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sconce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sconce {

HWY_EXPORT(multiply_blocks);
HWY_EXPORT(combine_groups);

namespace {

/// Light and dark coefficients cancel, so that sums of what is exact are double.
void multiply_exactly(const WaveletRows& rows, std::span<const Rgbx> light, std::span<Rgb> out) {
  constexpr std::size_t kBlock = WaveletRows::kBlock;
  parallel_for(rows.rows, 64, [&](std::size_t row) {
    const std::size_t block = row / kBlock;
    double sums[3];
    for (std::size_t c = 0; c < 3; ++c)
      sums[c] = static_cast<double>(rows.means[row]) * static_cast<double>(light[0][c]);
    for (std::size_t k = rows.first[block]; k < rows.first[block + 1]; ++k) {
      const auto value = static_cast<double>(rows.values[kBlock * k + row % kBlock]);
      const Rgbx& l = light[rows.indices[k]];
      for (std::size_t c = 0; c < 3; ++c) sums[c] += value * static_cast<double>(l[c]);
    }
    out[row] = Rgb(static_cast<float>(sums[0]), static_cast<float>(sums[1]), static_cast<float>(sums[2]));
  });
}

}  // namespace

void multiply(const WaveletRows& rows, std::span<const Rgbx> light, std::span<Rgb> out, Zeros zeros) {
  if (!rows.values.empty()) return multiply_exactly(rows, light, out);
  std::vector<uint8_t> lit;
  if (zeros == Zeros::skip) {
    lit.resize(light.size());
    for (std::size_t c = 0; c < light.size(); ++c)
      lit[c] = light[c][0] != 0 || light[c][1] != 0 || light[c][2] != 0 ? 1 : 0;
  }
  constexpr std::size_t kGrain = 64;
  parallel_for((rows.blocks() + kGrain - 1) / kGrain, 1, [&](std::size_t part) {
    HWY_DYNAMIC_DISPATCH(multiply_blocks)
    (rows, part * kGrain, std::min(rows.blocks(), (part + 1) * kGrain), light.data(),
     lit.empty() ? nullptr : lit.data(), out.data());
  });
}

void combine(const ClusterRows& rows, std::span<const Rgb> basis, std::span<Rgb> out) {
  if (rows.plain()) {
    std::copy_n(basis.begin(), out.size(), out.begin());
    return;
  }
  const std::size_t groups = rows.scales.size() / ClusterRows::kLanes;
  constexpr std::size_t kGrain = 512;
  parallel_for((groups + kGrain - 1) / kGrain, 1, [&](std::size_t part) {
    HWY_DYNAMIC_DISPATCH(combine_groups)
    (rows, part * kGrain, std::min(groups, (part + 1) * kGrain), basis.data(), out.data());
  });
}

void multiply(const ClusterRows& rows, std::span<const Rgbx> light, std::span<Rgb> out, Zeros zeros) {
  if (rows.plain()) {
    WaveletRows own = rows.basis;
    own.rows = rows.rows;
    return multiply(own, light, out, zeros);
  }
  std::vector<Rgb> basis(ClusterRows::kRank * rows.clusters());
  multiply(rows.basis, light, basis, zeros);
  combine(rows, basis, out);
}

}  // namespace sconce
#endif
