// SPDX-License-Identifier: Apache-2.0
// Light fields drawn by OpenGL: against all their terms by rays, and against the same lamp baked.
#include <gtest/gtest.h>

#include <map>

#include "gpu/near_lights.h"
#include "gpu/view.h"
#include "image/io.h"
#include "photometry/light_field_file.h"
#include "picture/render.h"
#include "process.h"
#include "relight/moved_lamps.h"
#include "relight/test_near_spots.h"
#include "small_scenes.h"
#include "spots.h"

namespace sconce {
namespace {

using test::run_sconce;

/// A room that one light field lights, aslant, past a block, and one in colours from the other side; baked
/// and with an operator, once for all tests.
struct Room {
  TemporaryFolder folder;
  std::string package = (folder / "room.sconce").string();

  Room() {
    Scene scene = test::two_lamp_room();
    std::erase_if(scene.instances, [](const Instance& i) { return i.name.starts_with("lamp"); });
    write_file(folder / "room.glb", write_glb(scene, "test"));
    write_light_field(folder / "lamp.exr", test::spots());
    write_light_field(folder / "colored.exr", test::colored_spots());
    folder.write("room.toml",
                 "[[luminaire]]\nfile = \"lamp.exr\"\nat = [-0.3, 1.9, 0.5]\naim = [0.2, 0.2, -0.5]\n"
                 "group = \"torch\"\n"
                 "[[luminaire]]\nfile = \"colored.exr\"\nat = [0.3, 1.8, 0.3]\naim = [-0.2, 0.2, -0.4]\n"
                 "group = \"tricolour\"\n");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"bake", (folder / "room.glb").string(), "--density", "24", "--samples",
                                   "256"},
          std::vector<std::string>{"transfer", package, "--gather", "1024"}}) {
      const auto made = run_sconce(words);
      EXPECT_EQ(made.code, 0) << made.err;
    }
  }
};

const Room& room() {
  static const Room one;
  return one;
}

class NearLight : public testing::Test {
 protected:
  static constexpr int kSize = 96, kSide = 512;

  NearLight()
      : package_(Package::open(room().package)),
        view_(package_),
        lamps_(view_.scene(), view_.world(), view_.tracer(), {}, {&group_, 1}),
        lamp_(std::get<NearFieldLamp>(lamps_.lamps().all().at(0).shape)) {
    params_.width = params_.height = kSize, params_.samples = 1;
    camera_ = view_.camera("");
    black_.assign(static_cast<std::size_t>(package_.manifest().pages),
                  Image::rgb(package_.manifest().width, package_.manifest().height));
    mix_.weights.assign(package_.manifest().groups.size(), Rgb(0));
  }

  Image by_rays(bool shadows) const {
    return view_.render(
        camera_, mix_, black_, params_, {}, nullptr, [&](const SurfacePoint& at, int, int, uint32_t) {
          return lamp_.scale * static_cast<float>(near_spots(lamp_, at, shadows ? &view_.tracer() : nullptr));
        });
  }
  Image by_opengl(const gpu::NearLightParams& params, gpu::NearLights::Passes* passes = nullptr) {
    return by_opengl(lamps_, params, passes);
  }
  Image by_opengl(const MovedLamps& lamps, const gpu::NearLightParams& params,
                  gpu::NearLights::Passes* passes) {
    gpu::View view(context_, view_.shown());
    gpu::NearLights light(context_, view.geometry(), view_.world().bounds, lamps.lamps(), lamps.chosen(),
                          params);
    gpu::AddedLight* added[] = {&light};
    view.draw(camera_, mix_.weights, gpu::MixedPages(context_, black_), params_, {}, {.added = added});
    if (passes != nullptr) *passes = light.passes();
    return view.linear();
  }
  static double mean(const Image& image) {
    double sum = 0;
    for (const float v : image.data) sum += static_cast<double>(v) / static_cast<double>(image.data.size());
    return sum;
  }

  /// What the middle of a pixel shows; empty where that is nothing.
  std::string wall_at(int x, int y) const {
    const Lens lens(camera_, params_);
    const Hit hit = view_.tracer().closest(
        {lens.eye(), lens.direction({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f})});
    return hit ? view_.scene()[view_.world().instances[hit.triangle]].name : "";
  }

  /// Whether the edge of a term's shadow is at most two texels away from what a pixel sees.
  bool near_edge(int x, int y) const {
    const Lens lens(camera_, params_);
    const Hit hit = view_.tracer().closest(
        {lens.eye(), lens.direction({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f})});
    if (!hit) return false;
    return near_shadow_edge(lamp_, surface_point(view_.world(), hit), view_.tracer(), kSide);
  }

  const MovedGroup group_{Id<LightGroup>(0), Rgb(1)};
  const Package package_;
  const View view_;
  const MovedLamps lamps_;
  const NearFieldLamp& lamp_;
  const gpu::Context context_;
  Camera camera_;
  PictureParams params_;
  std::vector<Image> black_;
  MixSpec mix_;
};

TEST_F(NearLight, AllTermsAsByRays) {
  const Image rays = by_rays(false), device = by_opengl({.shadow_side = 0});
  const double all = mean(rays);
  ASSERT_GT(all, 1);
  std::size_t alike = 0;  // but for silhouettes
  for (std::size_t i = 0; i < rays.data.size(); ++i)
    alike += std::abs(device.data[i] - rays.data[i]) <=
             1e-3 * std::max(std::abs(static_cast<double>(rays.data[i])), 0.01 * all);
  EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(rays.data.size()));
}

TEST_F(NearLight, EveryTermHasItsShadow) {
  const Image open = by_rays(false), rays = by_rays(true), device = by_opengl({.shadow_side = kSide});
  const double all = mean(rays);
  std::size_t compared = 0, alike = 0, shaded = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      if (near_edge(x, y)) continue;
      const auto a = static_cast<double>(rays.rgb_at(x, y).g), b = static_cast<double>(device.rgb_at(x, y).g);
      ++compared;
      shaded += std::abs(static_cast<double>(open.rgb_at(x, y).g) - a) > 0.1 * all;
      alike += std::abs(a - b) <= 1e-3 * std::max(std::abs(a), 0.01 * all);
    }
  EXPECT_GT(shaded, 100u) << "the block's shadow is in the picture";
  EXPECT_GT(compared, 8u * kSize * kSize / 10);
  EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(compared)) << "of " << compared;
}

// The paper's (X + 1) N / X passes, where one draw fills all X layers; whatever X, the sum is the same.
TEST_F(NearLight, FewerTermsInAPassAreTheSamePicture) {
  gpu::NearLights::Passes passes;
  const Image whole = by_opengl({.shadow_side = kSide}, &passes);
  EXPECT_EQ(passes.lighting, 1);
  const int terms = lamp_.field->finest().field().columns * lamp_.field->finest().field().rows;
  const double all = mean(whole);
  for (const int most : {3, 7}) {
    const Image parts = by_opengl({.shadow_side = kSide, .terms_per_pass = most}, &passes);
    EXPECT_EQ(passes.lighting, (terms + most - 1) / most);
    EXPECT_EQ(passes.shadows, passes.lighting);
    for (std::size_t i = 0; i < whole.data.size(); ++i)
      ASSERT_NEAR(parts.data[i], whole.data[i],
                  1e-4 * std::abs(static_cast<double>(whole.data[i])) + 1e-5 * all);
  }
  // 8 bits: each pass rounds by at most 1/254 of the largest sum until then.
  const Image codes = by_opengl({.shadow_side = kSide, .terms_per_pass = 7, .srgbe = true}, &passes);
  double off = 0;
  for (std::size_t i = 0; i < whole.data.size(); ++i)
    off += std::abs(static_cast<double>(codes.data[i]) - static_cast<double>(whole.data[i])) /
           static_cast<double>(whole.data.size());
  EXPECT_LT(off, 0.01 * all);
  EXPECT_GT(off, 0) << "they are 8 bits";
}

// Red, green and blue each have terms of their own, and all the same maps; in 8 bits, too.
TEST_F(NearLight, ColoursAreDrawnAsByRays) {
  const MovedGroup group{Id<LightGroup>(1), Rgb(1, 2, 3)};
  const MovedLamps lamps(view_.scene(), view_.world(), view_.tracer(), {}, {&group, 1});
  const auto& lamp = std::get<NearFieldLamp>(lamps.lamps().all().at(lamps.chosen()[0].first).shape);
  ASSERT_EQ(lamp.field->channels(), 3u);
  const Image rays = view_.render(
      camera_, mix_, black_, params_, {}, nullptr, [&](const SurfacePoint& at, int, int, uint32_t) {
        const auto channel = [&](std::size_t c) {
          return static_cast<float>(near_spots(lamp, at, nullptr, c));
        };
        return Rgb(1, 2, 3) * lamp.scale * Rgb(channel(0), channel(1), channel(2));
      });
  const double all = mean(rays);
  gpu::NearLights::Passes passes;
  const auto alike = [&](const Image& device, double share) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.data.size(); ++i)
      count += std::abs(device.data[i] - rays.data[i]) <=
               share * std::max(std::abs(static_cast<double>(rays.data[i])), 10 * share * all);
    return static_cast<double>(count) / static_cast<double>(rays.data.size());
  };
  EXPECT_GE(alike(by_opengl(lamps, {.shadow_side = 0}, &passes), 1e-3), 0.995);
  EXPECT_EQ(passes.lighting, 3);
  EXPECT_GE(alike(by_opengl(lamps, {.shadow_side = 0, .terms_per_pass = 7, .srgbe = true}, &passes), 0.05),
            0.95);
  by_opengl(lamps, {.shadow_side = 64}, &passes);
  EXPECT_EQ(passes.shadows, 1) << "maps are drawn once";
}

// The lamp baked into its group, and the same lamp by relight: means over what is lit of each wall, but for
// its rim.
TEST_F(NearLight, BakedAndInteractiveAgree) {
  const auto picture = [&](std::vector<std::string> words, const char* name) {
    const std::string file = (room().folder / name).string();
    for (const char* more : {"--size", "96x96", "--samples", "16", "--no-reflections", "-o", file.c_str()})
      words.emplace_back(more);
    const auto drawn = run_sconce(words);
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    return read_exr(file);
  };
  const Image baked = picture({"render", room().package}, "baked.exr");
  for (const char* device : {"cpu", "gl"}) {
    const Image live = picture({"relight", room().package, "--light", "group,name=torch", "--light",
                                "group,name=tricolour", "--device", device},
                               "live.exr");
    std::map<std::string, std::pair<Rgb, Rgb>> walls;
    std::map<std::string, int> pixels;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const std::string wall = wall_at(x, y);
        bool whole = !wall.empty() && baked.rgb_at(x, y).g > 0.1f * static_cast<float>(mean(baked));
        for (int k = 0; k < 9; ++k) whole &= wall_at(x - 1 + k % 3, y - 1 + k / 3) == wall;
        if (!whole) continue;
        walls[wall].first += baked.rgb_at(x, y);
        walls[wall].second += live.rgb_at(x, y);
        ++pixels[wall];
      }
    int seen = 0;
    for (const auto& [name, sums] : walls) {
      if (pixels[name] < 200) continue;
      ++seen;
      EXPECT_NEAR(sums.second.r / sums.first.r, 1, 0.02) << name << ", " << device;
      EXPECT_NEAR(sums.second.g / sums.first.g, 1, 0.02) << name << ", " << device;
      EXPECT_NEAR(sums.second.b / sums.first.b, 1, 0.02) << name << ", " << device;
    }
    EXPECT_GE(seen, 4);
  }
}

}  // namespace
}  // namespace sconce
