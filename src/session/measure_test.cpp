// SPDX-License-Identifier: Apache-2.0
// Light at points, readings and goals, on a package whose light is known.
#include "session/measure.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "package/test_package.h"
#include "session/goals.h"
#include "session/opened.h"
#include "session/reading.h"
#include "session/reference.h"

namespace sconce {
namespace {

class Measured : public testing::Test {
 protected:
  /// The test package with `groups` groups; the first one is a point light of 100 cd at z = 1.
  std::shared_ptr<Opened> open(int groups, int side = 16) {
    PackageContents c = test_package(groups, 1, side, side);
    std::mt19937 random(1);
    for (auto& layer : c.layers)
      for (float& v : layer[0].data) v = static_cast<float>(random() % 1000) / 10;
    Light lamp;
    lamp.name = "lamp";
    lamp.frame[3] = {0, 0, 1, 1};
    lamp.intensity = Rgb(100);
    lamp.shape = sconce::PointLight{};
    lamp.group = Id<LightGroup>(0);
    c.scene.lights.push_back(lamp);
    write_package(folder_ / "x.sconce", c);
    return std::make_shared<Opened>(folder_ / "x.sconce");
  }
  TemporaryFolder folder_;
};

// I / d2, and nothing but the lamp before the point.
TEST_F(Measured, InverseSquare) {
  const auto opened = open(2);
  PointMeter meter(opened->rays, {{{0, 0, 0.5f}, {0, 0, 1}, {0, 0, 1}}, {{0, 0, 0.2f}, {0, 0, 1}, {0, 0, 1}}},
                   ReceiverKind::plane);
  meter.pass(16, {});
  meter.pass(16, {});
  EXPECT_EQ(meter.light().samples, 32);
  const std::vector<float> lux = lux_of(meter.light(), {{Rgb(0.5f), Rgb(1)}});
  EXPECT_NEAR(lux[0], 0.5 * 100 / 0.25, 0.02);
  EXPECT_NEAR(lux[1], 0.5 * 100 / 0.64, 0.02);
  EXPECT_EQ(unreached(meter.light()), (std::vector<uint8_t>{0, 0}));
}

// The lamp went half a metre above the point; then it became one of 50 cd; then a shader, of which rays know
// nothing. Always in its group.
TEST_F(Measured, LampsAreMeasuredWhereTheyStand) {
  const auto opened = open(2);
  const auto lux = [&](const StandingLamp& lamp) {
    const auto scene = std::make_shared<const StandingScene>(
        standing_scene(opened->rays.scene(), opened->rays.world(), std::span(&lamp, 1)));
    PointMeter meter(scene, {{{0, 0, 0.3f}, {0, 0, 1}, {0, 0, 1}}}, ReceiverKind::plane);
    meter.pass(16, {});
    EXPECT_EQ(meter.light().mixed(0, {{Rgb(0), Rgb(1)}}).r, 0);
    return lux_of(meter.light(), {{Rgb(1), Rgb(0)}})[0];
  };
  StandingLamp lamp;
  lamp.motion[3] = {0, 0, -0.2f, 1};
  EXPECT_NEAR(lux(lamp), 100 / 0.25, 0.05);
  lamp.itself = false;
  EXPECT_EQ(lux(lamp), 0);
  Light other;
  other.frame[3] = {0, 0, 0.8f, 1};
  other.intensity = Rgb(50);
  other.shape = sconce::PointLight{};
  lamp.other = MoreLights{{other}, {}};
  EXPECT_NEAR(lux(lamp), 50 / 0.25, 0.05);
}

TEST(MeasuringPlane, PointsAreTheMiddlesOfCells) {
  Bounds room;
  room.add({0, 0, 0});
  room.add({4, 3, 6});
  const MeasuringPlane plane = horizontal_plane(room, 0.75f, 0.5f);
  EXPECT_EQ(plane.columns, 7);  // 4 m - 2 x 0.4 m
  EXPECT_EQ(plane.rows, 10);    // 6 m - 2 x 0.5 m
  EXPECT_NEAR(glm::length(plane.normal() - Vec3(0, 1, 0)), 0, 1e-6f);
  EXPECT_FLOAT_EQ(plane.points().front().position.y, 0.75f);
  EXPECT_EQ(plane.points().size(), 70u);
  EXPECT_THROW((MeasuringPlane{.rows = 0}.points()), UsageError);
  const std::vector<float> lux{100, 200, 300};
  const LuxStatistics s = lux_statistics(lux);
  EXPECT_EQ(s.average, 200);
  EXPECT_EQ(s.uniformity(), 0.5);
  EXPECT_NEAR(s.diversity(), 1.0 / 3, 1e-12);
}

TEST_F(Measured, ReadingsAreWhatPicturesShow) {
  const auto opened = open(3);
  const MixSpec mix{{Rgb(0.5f), Rgb(2), Rgb(0)}};
  const PictureParams params{.width = 9, .height = 9, .samples = 1};
  const Camera camera = opened->rays.camera("");
  const Image picture = opened->rays.render(camera, mix, mix_pages(opened->package, mix), params);
  for (int i = 0; i < 9; ++i) {
    const Reading r =
        read_pixel(opened->rays, opened->layers, mix, camera, params, Vec2(i, 8 - i) + Vec2(0.5f));
    ASSERT_TRUE(r.surface);
    EXPECT_NEAR(r.luminance, luminance(picture.rgb_at(i, 8 - i)), 1e-4f * r.luminance);
    EXPECT_NEAR(r.group_lux[0] + r.group_lux[1], luminance(r.illuminance), 1e-3f);
    EXPECT_EQ(r.group_lux[2], 0);
  }
}

// Twenty-four faders from a picture alone, to 1 %.
TEST_F(Measured, PicturesGiveTheirFadersAway) {
  const auto opened = open(24, 64);
  const Manifest& m = opened->package.manifest();
  Faders faders{.groups = std::vector<Fader>(24)};
  for (std::size_t g = 0; g < 24; ++g)
    faders.groups[g].gain = 0.1 + 0.17 * static_cast<double>(g), faders.groups[g].on = g % 7 != 3;
  const MixSpec mix = make_mix(m.groups, faders);
  const Camera camera = opened->rays.camera("");
  const Image picture = opened->rays.render(camera, mix, mix_pages(opened->package, mix),
                                            {.width = 320, .height = 320, .samples = 4, .seed = 9});
  Wishes wishes(24);
  wish_picture(wishes, opened->rays, grouped_light(layers_of(opened)), camera, unit_weights(m.groups, faders),
               picture);
  const Fit found = fit(wishes);
  for (std::size_t g = 0; g < 24; ++g)
    EXPECT_NEAR(found.gains[g], faders.groups[g].on ? faders.groups[g].gain : 0,
                0.01 * std::max(faders.groups[g].gain, 1.0))
        << g;
  const Faders moved = with_gains(faders, found.gains);
  EXPECT_FALSE(moved.groups[0].solo);
  EXPECT_THROW(wish_picture(wishes, opened->rays, grouped_light(layers_of(opened)), camera,
                            unit_weights(m.groups, faders), Image::rgb(4, 4)),
               Error);
}

TEST_F(Measured, ReferencesAreMadeOfTracedLight) {
  const auto opened = open(1);
  const Camera camera = opened->rays.camera("");
  const PictureParams params{.width = 3, .height = 3, .samples = 1};
  const ReferencePicture reference(opened->rays, camera, params);
  PointMeter meter = reference.meter();
  meter.pass(8, {});
  // The middle pixel: 100 cd one metre above albedo 0.5.
  EXPECT_NEAR(reference.picture(meter.light(), {{Rgb(2)}}).rgb_at(1, 1).g, 2 * 100 * 0.5f * kInvPi, 0.01f);
}

TEST_F(Measured, NoiseAddsInSquares) {
  const auto opened = open(2);
  const MixSpec one{{Rgb(1), Rgb(0)}};
  const std::vector<Image> noise = mixed_noise(*opened, one);
  for (const float v : noise[0].data) ASSERT_NEAR(v, 25, 0.01f);
}

}  // namespace
}  // namespace sconce
