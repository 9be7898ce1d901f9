// SPDX-License-Identifier: Apache-2.0
// Some thousand points meter as all texels do.
#include "web/meter_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mix/mix.h"
#include "package/test_package.h"

namespace sconce::web {
namespace {

/// What web/sconce-three/src/exposure.ts does with the points.
double log_mean(const MeterPoints& points, const MixSpec& mix) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < points.weights.size(); ++i) {
    double l = 0;
    for (std::size_t g = 0; g < points.groups; ++g) {
      const Rgb c = mix.weights[g] * points.values[i * points.groups + g];
      l += static_cast<double>(c.r + c.g + c.b);
    }
    sum += static_cast<double>(points.weights[i]) * std::log(l + 1e-4);
    weight += static_cast<double>(points.weights[i]);
  }
  return std::exp(sum / weight);
}

/// Wild layers: five decades of light, a spot that only one group has, a third of the texels empty.
PackageContents wild_package() {
  PackageContents contents = test_package(3, 1, 256, 256);
  for (std::size_t g = 0; g < 3; ++g) {
    Image& layer = contents.layers[g].front();
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 256; ++x) {
        const float wave = std::sin(0.05f * static_cast<float>(x * static_cast<int>(g + 1))) *
                           std::cos(0.03f * static_cast<float>(y));
        const float e = std::exp(4 * wave) * (g == 2 && x < 12 && y < 12 ? 1000.0f : 1.0f);
        layer.set_rgb(x, y, {e, 0.5f * e, 2 * e});
      }
  }
  Image& receivers = contents.receivers.front();
  for (std::size_t i = 0; i < receivers.pixels(); ++i) receivers.data[4 * i + 3] = static_cast<float>(i % 3);
  return contents;
}

TEST(MeterPoints, MeterAsAllTexels) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", wild_package());
  const Package package = Package::open(folder / "x.sconce");
  const MeterPoints points = choose_meter_points(package, ShownScene(package), {});
  EXPECT_LE(points.weights.size(), 6144u);
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{}, {"a=off"}, {"b=off", "c=off"}, {"c=+6ev,2700K"}}) {
    const MixSpec mix = make_mix(package.manifest().groups, settings, "", {});
    const Metering exact = meter(package, mix, mix_pages(package, mix));
    // ln E of one group deviates by 4 / 2; one standard error of 3072 points that know nothing of each other.
    EXPECT_NEAR(log_mean(points, mix) / exact.log_mean, 1, 2 / std::sqrt(3072.0));
  }
}

// A card that glows in one group: its luminance, its area.
TEST(MeterPoints, EmittersByArea) {
  PackageContents contents = test_package(1, 1, 8, 8);
  contents.scene.materials[0].emission = Rgb(10, 20, 30);
  contents.scene.instances[0].group_name = "a";
  contents.scene.instances[0].group = Id<LightGroup>(0);
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", contents);
  const Package package = Package::open(folder / "x.sconce");
  const MeterPoints points = choose_meter_points(package, ShownScene(package), {});
  ASSERT_EQ(points.emitters.size(), 1u);
  EXPECT_EQ(points.emitters[0].group, Id<LightGroup>(0));
  EXPECT_NEAR(points.emitters[0].weight, 4, 1e-5);
  const Rgb c = points.emitters[0].luminance;
  EXPECT_NEAR(c.r + c.g + c.b, 0.2126f * 10 + 0.7152f * 20 + 0.0722f * 30, 1e-4f);
}

}  // namespace
}  // namespace sconce::web
