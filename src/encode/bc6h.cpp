// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/parallel.h"
#include "encode/bc6h_block.h"
#include "encode/half.h"
#include "encode/rows.h"
#include "encode/texels.h"

namespace sconce {

namespace {

constexpr int kSide = 4;

std::size_t blocks_across(int width) {
  return static_cast<std::size_t>((width + kSide - 1) / kSide);
}

/// Texels outside the image repeat its edge.
HalfBlock gather_block(const Image& image, int x0, int y0) {
  HalfBlock block;
  for (int t = 0; t < 16; ++t) {
    const float* rgb =
        image.at(std::min(x0 + t % kSide, image.width - 1), std::min(y0 + t / kSide, image.height - 1));
    for (std::size_t k = 0; k < 3; ++k)
      block[static_cast<std::size_t>(t)][k] =
          float_to_half(std::min(texels::clean_positive(rgb[k]), kLargestHalf));
  }
  return block;
}

void encode_bc6h(const Image& image, EncodedImage& out) {
  const std::size_t across = blocks_across(image.width), down = blocks_across(image.height);
  parallel_for(down, 4, [&](std::size_t by) {
    for (std::size_t bx = 0; bx < across; ++bx) {
      const auto block =
          encode_bc6h_block(gather_block(image, static_cast<int>(bx) * kSide, static_cast<int>(by) * kSide));
      std::memcpy(&out.data[(by * across + bx) * block.size()], block.data(), block.size());
    }
  });
}

void decode_bc6h(const EncodedImage& in, int first, int rows, float* out) {
  const std::size_t across = blocks_across(in.width);
  for (int y0 = first; y0 < first + rows; y0 += kSide)
    for (std::size_t bx = 0; bx < across; ++bx) {
      const std::size_t at = (static_cast<std::size_t>(y0 / kSide) * across + bx) * 16;
      const HalfBlock block =
          decode_bc6h_block(std::span<const uint8_t, 16>(reinterpret_cast<const uint8_t*>(&in.data[at]), 16));
      for (int t = 0; t < 16; ++t) {
        const int x = static_cast<int>(bx) * kSide + t % kSide, y = y0 + t / kSide;
        if (x >= in.width || y >= first + rows) continue;
        float* rgb = out + 3 * (static_cast<std::size_t>(y - first) * static_cast<std::size_t>(in.width) +
                                static_cast<std::size_t>(x));
        for (std::size_t k = 0; k < 3; ++k) rgb[k] = half_to_float(block[static_cast<std::size_t>(t)][k]);
      }
    }
}

constexpr std::string_view kGlsl =
#include "encode/bc6h.glsl.h"
    ;

}  // namespace

// The error is that of blocks whose texels differ smoothly by less than a tenth; of others it has no bound
// below the block's contrast.
constexpr Encoding kEncodingBc6h{
    .name = "bc6h",
    .doc =
        "blocks of 4 x 4 on a line between two colours: 1.2 % of the block's largest where it is smooth; 1 "
        "byte per texel",
    .max_relative_error = 0.012,
    .smallest = kSmallestNormalHalf,
    .largest = kLargestHalf,
    .is_signed = false,
    .per_channel = false,
    .filters = true,
    .has_gain = false,
    .type = TexelType::bc6h,
    .stored_channels = 3,
    .planes = 1,
    .glsl = kGlsl,
    .encode = encode_bc6h,
    .decode = decode_bc6h,
};

}  // namespace sconce
