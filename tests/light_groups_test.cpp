// SPDX-License-Identifier: Apache-2.0
// Pictures with light groups by Blender's Cycles: mixed, they are what Cycles renders with the lights so set.
#include <gtest/gtest.h>

#include "blender.h"
#include "image/io.h"
#include "image/metrics.h"
#include "process.h"

namespace sconce {
namespace {

class LightGroups : public test::BlenderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  TemporaryFolder folder_;
};

Image colours(const Image& image) {
  Image out = Image::rgb(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) out.set_rgb(x, y, image.rgb_at(x, y));
  return out;
}

TEST_F(LightGroups, MixIsWhatCyclesRenders) {
  const std::string command = test::blender() +
                              " -b --factory-startup -P " SCONCE_SOURCE_DIR "/tests/light_groups.py -- " +
                              path("") + " 256 key=2 fill=0.25 world=0.5 >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const test::Outcome info = test::run_sconce({"info", path("groups.exr")});
  ASSERT_EQ(info.code, 0) << info.err;
  for (const char* word : {"Blender Cycles", "key", "fill", "world", "rest", "ViewLayer.Depth.Z"})
    EXPECT_NE(info.out.find(word), std::string::npos) << info.out;

  ASSERT_EQ(test::run_sconce({"mix", path("groups.exr"), "-o", path("same.exr")}).code, 0);
  const Image beauty = read_exr(path("groups.exr")), same = read_exr(path("same.exr"));
  EXPECT_EQ(same.channels, (std::vector<std::string>{"R", "G", "B", "A", "ViewLayer.Depth.Z"}));
  for (std::size_t k = 0; k < 4; ++k) {
    const int from = beauty.channel(std::string("ViewLayer.Combined.") + "RGBA"[k]);
    ASSERT_GE(from, 0);
    for (std::size_t i = 0; i < same.pixels(); ++i)
      ASSERT_EQ(same.data[i * same.stride() + k],
                beauty.data[i * beauty.stride() + static_cast<std::size_t>(from)]);
  }

  ASSERT_EQ(
      test::run_sconce({"mix", path("groups.exr"), "key=2", "fill=25%", "world=-1ev", "-o", path("mix.exr")})
          .code,
      0);
  const Image mix = colours(read_exr(path("mix.exr")));
  Image again = read_exr(path("again.exr"));
  Image truth = Image::rgb(again.width, again.height);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto from = static_cast<std::size_t>(again.channel(std::string("ViewLayer.Combined.") + "RGB"[k]));
    for (std::size_t i = 0; i < truth.pixels(); ++i)
      truth.data[3 * i + k] = again.data[i * again.stride() + from];
  }
  EXPECT_NEAR(compare(mix, truth).mean_ratio, 1, 0.01);
  // Both are noisy.
  EXPECT_LT(relative_rmse(mix, truth, nullptr, nullptr).rmse, 0.03);
  // That faders matter.
  EXPECT_GT(relative_rmse(colours(same), truth, nullptr, nullptr).rmse, 0.2);
}

}  // namespace
}  // namespace sconce
