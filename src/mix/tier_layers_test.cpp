// SPDX-License-Identifier: Apache-2.0
#include "mix/tier_layers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sconce {
namespace {

// Direct sun, above 65504 lux, is no half.
TEST(Tiers, WhatIsTooBrightForHalvesKeepsItsLight) {
  for (const float lux : {5e4f, 1e5f}) {
    Image image = Image::rgb(2, 2);
    std::fill(image.data.begin(), image.data.end(), lux);
    const EncodedLayers layers =
        for_tier(encode_layers({parse_encoding("f32")}, 1, {Rgb(1)}, [&](std::size_t, int) { return image; }),
                 find_shader_tier("half"));
    EXPECT_EQ(layers.textures[0].encoding.name(), lux > 65504 ? "rgbe8" : "f16");
    EXPECT_NEAR(decode(layers.images[0][0]).data[0], lux, lux / 256);
  }
}

}  // namespace
}  // namespace sconce
