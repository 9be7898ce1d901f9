// SPDX-License-Identifier: Apache-2.0
#include "mix/mix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "package/test_package.h"

namespace sconce {
namespace {

class Mix : public testing::Test {
 protected:
  Package write(const PackageContents& contents) {
    write_package(folder_ / "x.sconce", contents);
    return Package::open(folder_ / "x.sconce");
  }
  TemporaryFolder folder_;
};

TEST_F(Mix, OneGroupAtOneIsItsLayerBitForBit) {
  const PackageContents c = test_package(3, 2, 33, 70);
  const Package package = write(c);
  for (int page = 0; page < 2; ++page)
    EXPECT_EQ(mix_page(package, {{Rgb(0), Rgb(1), Rgb(0)}}, page).data,
              c.layers[1][static_cast<std::size_t>(page)].data);
}

TEST_F(Mix, IsTheWeightedSumAtAnyThreadCount) {
  const PackageContents c = test_package(3, 2, 33, 70);
  const Package package = write(c);
  const MixSpec mix{{{0.5f, 1, 2}, {0, 0.25f, 0}, {3, 0, 1}}};
  std::vector<Image> one;
  {
    const ThreadLimit limit(1);
    one = mix_pages(package, mix);
  }
  const std::vector<Image> many = mix_pages(package, mix);
  ASSERT_EQ(many.size(), 2u);
  for (std::size_t page = 0; page < 2; ++page) {
    EXPECT_EQ(one[page].data, many[page].data);
    for (int y = 0; y < 70; y += 7)
      for (int x = 0; x < 33; x += 4) {
        Rgb expected;
        for (std::size_t g = 0; g < 3; ++g) expected += mix.weights[g] * c.layers[g][page].rgb_at(x, y);
        EXPECT_NEAR(many[page].rgb_at(x, y).r, expected.r, 1e-5f * expected.r);
        EXPECT_NEAR(many[page].rgb_at(x, y).b, expected.b, 1e-5f * expected.b);
      }
  }
}

TEST_F(Mix, DarkLayersAreNotRead) {
  const Package package = write(test_package(2, 1, 4, 4));
  std::filesystem::remove(package.path() / "layers/b.0.exr");
  EXPECT_NO_THROW(mix_page(package, {{Rgb(1), Rgb(0)}}, 0));
  EXPECT_THROW(mix_page(package, {{Rgb(1), Rgb(1)}}, 0), Error);
  EXPECT_THROW(mix_page(package, {{Rgb(1)}}, 0), Error);
}

PackageContents constant(float lux) {
  PackageContents c = test_package(1, 1, 10, 100);
  for (float& v : c.layers[0][0].data) v = lux;
  return c;
}

TEST_F(Mix, MeteringOfAnEvenlyLitPage) {
  const Package package = write(constant(100));
  const MixSpec mix{{Rgb(2)}};
  const Metering metering = meter(package, mix, mix_pages(package, mix));
  const double l = 0.5 / 3.14159265358979 * 200;
  EXPECT_NEAR(metering.log_mean, l, 1e-4 * l + 1e-4);
  EXPECT_NEAR(metering.maximum, l, 1e-5 * l);
}

// A quarter of the weight at 10 lux, the rest at 1000; texels without weight, or that mirror alone, count for
// nothing.
TEST_F(Mix, MeteringWeighsTexels) {
  PackageContents c = constant(1000);
  Image& layer = c.layers[0][0];
  Image& receivers = c.receivers[0];
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 10; ++x) {
      if (y < 50) layer.set_rgb(x, y, Rgb(10));
      receivers.at(x, y)[3] = y < 50 ? 1.0f : 3.0f;
      if (x == 9) {
        layer.set_rgb(x, y, Rgb(1e9f));
        receivers.at(x, y)[3] = 0;
      }
      if (x == 8) std::fill_n(receivers.at(x, y), 3, 0.0f);
    }
  const Package package = write(c);
  const MixSpec mix{{Rgb(1)}};
  const Metering metering = meter(package, mix, mix_pages(package, mix));
  const double scale = 0.5 / 3.14159265358979;
  EXPECT_NEAR(metering.log_mean, scale * std::pow(10, 0.25 * 1 + 0.75 * 3), 1e-2);
  EXPECT_NEAR(metering.maximum, scale * 1000, 1e-2);
}

TEST_F(Mix, MaximumIsTheThousandthFromTheTop) {
  PackageContents c = constant(1);
  for (int i = 0; i < 1000; ++i)
    c.layers[0][0].set_rgb(i % 10, i / 10, Rgb(std::exp2(static_cast<float>(i) / 64.0f)));
  const Package package = write(c);
  const Metering metering = meter(package, {{Rgb(1)}}, mix_pages(package, {{Rgb(1)}}));
  EXPECT_NEAR(metering.maximum / (0.5 / 3.14159265358979 * std::exp2(998 / 64.0)), 1, 0.012);
}

// Light over forty stops under uneven weights, on several bands of rows.
TEST_F(Mix, MeteringAgreesWithLogarithmsAndASort) {
  PackageContents c = test_package(1, 1, 60, 200);
  std::vector<std::pair<double, double>> sorted;  // luminance, weight
  double logs = 0, weights = 0;
  for (int i = 0; i < 60 * 200; ++i) {
    const auto random = [&](uint32_t salt) {
      return static_cast<float>(mix32(salt, static_cast<uint32_t>(i)) % 4096) / 4096;
    };
    const Rgb light = Rgb(1, 2, 3) * std::exp2(40 * random(1) - 20);
    const float weight = 0.1f + random(2);
    c.layers[0][0].set_rgb(i % 60, i / 60, light);
    c.receivers[0].at(i % 60, i / 60)[3] = weight;
    const double l = static_cast<double>(luminance(light)) * 0.5 / 3.14159265358979;
    sorted.emplace_back(l, weight);
    logs += static_cast<double>(weight) * std::log(l + 1e-4), weights += static_cast<double>(weight);
  }
  std::ranges::sort(sorted);
  const auto percentile = [&](double share) {
    double below = 0;
    return std::ranges::find_if(sorted, [&](const auto& s) { return (below += s.second) >= share * weights; })
        ->first;
  };

  const Package package = write(c);
  const Metering metering = meter(package, {{Rgb(1)}}, mix_pages(package, {{Rgb(1)}}));
  EXPECT_NEAR(metering.log_mean / std::exp(logs / weights), 1, 1e-5);
  for (const auto& [found, share] : {std::pair(metering.maximum, 0.999), {metering.bright, 0.8}}) {
    EXPECT_GE(found, percentile(share) * (1 - 1e-6));
    EXPECT_LE(found, percentile(share) * (1 + 1 / 64.0)) << "its bin's largest";
  }
}

TEST_F(Mix, MaximumSeesEmittersThroughTheirFader) {
  PackageContents c = constant(100);
  Material lamp = c.scene.materials[0];
  lamp.emission = Rgb(5000);
  c.scene.materials.push_back(lamp);
  c.scene.meshes.push_back(test_quad("lamp", Id<Material>(1), 3));
  Instance instance;
  instance.mesh = Id<Mesh>(1);
  instance.group = Id<LightGroup>(0);
  c.scene.instances.push_back(instance);
  c.manifest.instance_pages.push_back(-1);
  c.manifest.instance_twins.push_back(-1);
  const Package package = write(c);
  const auto maximum = [&](float w) {
    return meter(package, {{Rgb(w)}}, mix_pages(package, {{Rgb(w)}})).maximum;
  };
  EXPECT_NEAR(maximum(1), 5000, 1);
  EXPECT_NEAR(maximum(0.5f), 2500, 1);
  EXPECT_EQ(maximum(0), 0);
}

TEST_F(Mix, DarknessMetersAsDelta) {
  const Package package = write(constant(100));
  const MixSpec mix{{Rgb(0)}};
  EXPECT_NEAR(meter(package, mix, mix_pages(package, mix)).log_mean, 1e-4, 1e-9);
}

}  // namespace
}  // namespace sconce
