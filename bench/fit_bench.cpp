// SPDX-License-Identifier: Apache-2.0
// Goal seeking: twenty-four faders out of a picture of 1280 x 720, layers of 1024 x 1024 texels in halves.
#include <benchmark/benchmark.h>

#include <random>

#include "package/test_package.h"
#include "session/goals.h"
#include "session/opened.h"

using namespace sconce;

namespace {

constexpr int kGroups = 24, kSide = 1024;

void look_like_a_picture(benchmark::State& state) {
  const TemporaryFolder folder;
  PackageContents contents = test_package(kGroups, 1, kSide, kSide);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> at(0, kSide), size(0.1f * kSide, 0.3f * kSide);
  for (auto& layer : contents.layers) {  // a pool of light each
    const float u = at(random), v = at(random), width = size(random);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Vec2 away = (Vec2(x, y) - Vec2(u, v)) / width;
        layer[0].set_rgb(x, y, Rgb(100 * std::exp(-glm::dot(away, away))));
      }
  }
  contents.encodings.assign(kGroups, "f16");
  write_package(folder / "x.sconce", contents);
  const auto opened = std::make_shared<const Opened>(folder / "x.sconce");
  const std::vector<GroupInfo>& groups = opened->package.manifest().groups;
  Faders faders{.groups = std::vector<Fader>(kGroups)};
  for (std::size_t g = 0; g < kGroups; ++g) faders.groups[g].gain = 0.1 + 0.17 * static_cast<double>(g);
  const MixSpec mix = make_mix(groups, faders);
  const Camera camera = opened->rays.camera("");
  const Image picture = opened->rays.render(camera, mix, mix_pages(opened->package, mix),
                                           {.width = 1280, .height = 720, .samples = 4});
  const std::vector<Rgb> unit = unit_weights(groups, faders);
  double worst = 0;
  for (auto _ : state) {
    Wishes wishes(kGroups);
    wish_picture(wishes, opened->rays, grouped_light(layers_of(opened)), camera, unit, picture);
    const Fit found = fit(wishes);
    for (std::size_t g = 0; g < kGroups; ++g)
      worst = std::max(worst, std::abs(found.gains[g] / faders.groups[g].gain - 1));
  }
  state.counters["worst_percent"] = 100 * worst;
}

}  // namespace

BENCHMARK(look_like_a_picture)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
