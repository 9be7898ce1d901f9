// SPDX-License-Identifier: Apache-2.0
// What is seen through panes.
#include <gtest/gtest.h>

#include "encode/half.h"
#include "package/test_package.h"
#include "picture/render.h"

namespace sconce {
namespace {

class PicturePanes : public testing::Test {
 protected:
  Package write(const PackageContents& contents) {
    write_package(folder_ / "x.sconce", contents);
    return Package::open(folder_ / "x.sconce");
  }
  /// All groups at `weight`, seen by the scene's first camera, square.
  Image render(const PackageContents& contents, float weight = 1, int size = 16) {
    const Package package = write(contents);
    const View view(package);
    const MixSpec mix{std::vector<Rgb>(contents.manifest.groups.size(), Rgb(weight))};
    PictureParams params;
    params.width = params.height = size;
    params.reflections = reflections_;
    return view.render(view.camera(""), mix, mix_pages(package, mix), params);
  }
  TemporaryFolder folder_;
  int reflections_ = 0;
};

PackageContents constant(float lux) {
  PackageContents c = test_package(1, 1, 8, 8);
  for (float& v : c.layers[0][0].data) v = lux;
  return c;
}

/// Another quad in front of the grey one, nearer to the camera.
Instance& add_quad(PackageContents& c, const Material& material, float z, bool flipped) {
  c.scene.materials.push_back(material);
  c.scene.meshes.push_back(test_quad("quad2", Id<Material>(c.scene.materials.size() - 1), z, flipped));
  Instance instance;
  instance.name = "quad2";
  instance.mesh = Id<Mesh>(c.scene.meshes.size() - 1);
  instance.group = Id<LightGroup>(0);
  c.scene.instances.push_back(instance);
  c.manifest.instance_pages.push_back(-1);
  c.manifest.instance_twins.push_back(-1);
  return c.scene.instances.back();
}

void expect_all(const Image& image, const Rgb& expected) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      EXPECT_NEAR(image.rgb_at(x, y).r, expected.r, 1e-5f * expected.r + 1e-7f) << x << ", " << y;
      EXPECT_NEAR(image.rgb_at(x, y).g, expected.g, 1e-5f * expected.g + 1e-7f) << x << ", " << y;
      EXPECT_NEAR(image.rgb_at(x, y).b, expected.b, 1e-5f * expected.b + 1e-7f) << x << ", " << y;
    }
}

// Two panes in a row over pi lux on grey 0.5, each in a colour: what transmits is multiplied, what has holes
// shows them as they are.
TEST_F(PicturePanes, ThroughPanes) {
  PackageContents c = constant(kPi);
  Material pane;
  pane.base_color = Rgb(0.9f, 0.5f, 0.2f);
  pane.transmission = 1;
  add_quad(c, pane, 1, false);
  add_quad(c, pane, 1.1f, true);
  expect_all(render(c), 0.5f * pane.base_color * pane.base_color);
  pane.transmission = 0;
  pane.alpha_mode = Material::Alpha::blend;
  pane.alpha = 0.25f;
  add_quad(c, pane, 1.2f, false);
  expect_all(render(c), 0.75f * 0.5f * c.scene.materials[1].base_color * c.scene.materials[1].base_color);
}

// A pane shows its own light by what does not pass: alpha ((1 - tau) rho + tau rho L) + (1 - alpha) L.
TEST_F(PicturePanes, PanesOwnLight) {
  PackageContents c = constant(kPi);
  Material pane;
  pane.base_color = Rgb(0.8f);
  pane.transmission = 0.25f;
  pane.alpha_mode = Material::Alpha::blend;
  pane.alpha = 0.5f;
  add_quad(c, pane, 1, false);
  c.manifest.instance_pages.back() = 0;
  expect_all(render(c), Rgb(0.5f * (0.75f * 0.8f + 0.25f * 0.8f * 0.5f) + 0.5f * 0.5f));
}

// Smooth glass also mirrors: 4 % head on, here of a black room.
TEST_F(PicturePanes, GlassMirrors) {
  PackageContents c = constant(kPi);
  Material pane;
  pane.transmission = 1;
  pane.roughness = 0;
  add_quad(c, pane, 1, false);
  expect_all(render(c), Rgb(0.5f));
  reflections_ = 2;
  EXPECT_NEAR(render(c, 1, 17).rgb_at(8, 8).g, 0.96f * 0.5f, 1e-4f);
}

// Cached hits take a pane or what is behind it by chance: right over many.
TEST_F(PicturePanes, CachedHitsThroughPanes) {
  PackageContents c = constant(kPi);
  Material pane;
  pane.base_color = Rgb(0);
  pane.alpha_mode = Material::Alpha::blend;
  pane.alpha = 0.25f;
  add_quad(c, pane, 1, false);
  const Package package = write(c);
  const View view(package);
  const PictureParams params{.width = 100, .height = 100};
  double sum = 0;
  for (const CameraHits::Pixel& pixel : view.hits(view.camera(""), params).pixels)
    sum += static_cast<double>(half_to_float(pixel.albedo[1])) * static_cast<double>(kPi);
  EXPECT_NEAR(sum / 1e4, 0.75 * 0.5, 5 * 0.5 * std::sqrt(0.75 * 0.25 / 1e4));
}

}  // namespace
}  // namespace sconce
