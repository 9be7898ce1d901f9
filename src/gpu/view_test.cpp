// SPDX-License-Identifier: Apache-2.0
// Pictures whose values are known. That they equal the CPU's is tested in tests/gl_test.cpp.
#include "gpu/view.h"

#include "core/error.h"
#include "gpu/test_context.h"
#include "mix/mix.h"
#include "package/test_package.h"

namespace sconce::gpu {
namespace {

class Picture : public GlTest {
 protected:
  /// All groups at `weight`, seen by the scene's first camera, square.
  Image render(const PackageContents& contents, float weight = 1, Image* coverage = nullptr) {
    write_package(folder_ / "x.sconce", contents);
    const Package package = Package::open(folder_ / "x.sconce");
    const ShownScene shown(package);
    View view(context_, shown);
    const MixSpec mix{std::vector<Rgb>(contents.manifest.groups.size(), Rgb(weight))};
    PictureParams params;
    params.width = params.height = 16;
    params.samples = samples_;
    view.draw(shown.scene.cameras.front(), mix.weights, MixedPages(context_, mix_pages(package, mix)),
              params);
    if (coverage != nullptr) *coverage = view.coverage();
    return view.linear();
  }
  static void expect_all(const Image& image, const Rgb& expected) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
          ASSERT_NEAR(image.rgb_at(x, y).*channel, expected.*channel, 1e-5f * expected.*channel + 1e-7f)
              << x << ", " << y;
  }
  static PackageContents constant(float lux) {
    PackageContents c = test_package(1, 1, 8, 8);
    for (float& v : c.layers[0][0].data) v = lux;
    return c;
  }
  TemporaryFolder folder_;
  int samples_ = 1;
};

TEST_F(Picture, EvenLightOnAnEvenWall) {
  expect_all(render(constant(100)), Rgb(0.5f * kInvPi * 100));
  samples_ = 5;
  expect_all(render(constant(100), 0.25f), Rgb(0.5f * kInvPi * 25));
}

TEST_F(Picture, BacksAreBlackAndBlock) {
  PackageContents c = constant(100);
  c.scene.meshes[0] = test_quad("quad", Id<Material>(0), 0, true);
  expect_all(render(c), Rgb(0));
}

TEST_F(Picture, EmittersFollowTheirFader) {
  PackageContents c = constant(0);
  c.scene.materials[0].emission = {10, 20, 4000};
  c.scene.instances[0].group = Id<LightGroup>(0);
  Image coverage;
  expect_all(render(c, 0.5f, &coverage), {5, 10, 2000});
  for (const float v : coverage.data) EXPECT_EQ(v, 1);
}

TEST_F(Picture, SkiesAreSeenWhereNothingIs) {
  PackageContents c = constant(100);
  c.scene.cameras[0].frame = glm::mat4(1);
  c.scene.cameras[0].frame[3] = {0, 0, -2, 1};  // past the wall, looking away
  Light sky;
  sky.intensity = {1, 2, 3};
  sky.group = Id<LightGroup>(0);
  sky.shape = SkyLight{};
  c.scene.lights = {sky};
  Image coverage;
  expect_all(render(c, 2, &coverage), {2, 4, 6});
  for (const float v : coverage.data) EXPECT_EQ(v, 1);
}

TEST_F(Picture, BadRequestsSaySo) {
  const PackageContents c = constant(1);
  write_package(folder_ / "x.sconce", c);
  const Package package = Package::open(folder_ / "x.sconce");
  const ShownScene shown(package);
  View view(context_, shown);
  const MixedPages light(context_, {Image::rgb(8, 8)});
  PictureParams params;
  params.samples = 0;
  EXPECT_THROW(view.draw(shown.scene.cameras[0], {Rgb(1)}, light, params), UsageError);
  params = {.width = context_.capabilities().max_texture_size + 1, .height = 1};
  EXPECT_THROW(view.draw(shown.scene.cameras[0], {Rgb(1)}, light, params), Error);
  Camera blind = shown.scene.cameras[0];
  blind.frame[2] = glm::vec4(0);
  EXPECT_THROW(view.draw(blind, {Rgb(1)}, light, {}), Error);
}

}  // namespace
}  // namespace sconce::gpu
