// SPDX-License-Identifier: Apache-2.0
// For tests only: a package's picture by rays, and what stands before its wall.
#pragma once

#include <gtest/gtest.h>

#include "package/test_package.h"
#include "picture/render.h"

namespace sconce {

class Picture : public testing::Test {
 protected:
  Package write(const PackageContents& contents) {
    write_package(folder_ / "x.sconce", contents);
    return Package::open(folder_ / "x.sconce");
  }
  /// All groups at `weight`, seen by the scene's first camera, square.
  Image render(const PackageContents& contents, float weight = 1, int size = 16, Image* coverage = nullptr) {
    const Package package = write(contents);
    const View view(package);
    const MixSpec mix{std::vector<Rgb>(contents.manifest.groups.size(), Rgb(weight))};
    PictureParams params;
    params.width = params.height = size;
    params.reflections = reflections_;
    return view.render(view.camera(""), mix, mix_pages(package, mix), params, {}, coverage);
  }
  TemporaryFolder folder_;
  int reflections_ = 0;
};

inline PackageContents constant(float lux) {
  PackageContents c = test_package(1, 1, 8, 8);
  for (float& v : c.layers[0][0].data) v = lux;
  return c;
}

/// Another quad in front of the grey one, nearer to the camera.
inline Instance& add_quad(PackageContents& c, const Material& material, float z, bool flipped) {
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

inline void expect_all(const Image& image, const Rgb& expected) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      EXPECT_NEAR(image.rgb_at(x, y).r, expected.r, 1e-5f * expected.r + 1e-7f) << x << ", " << y;
      EXPECT_NEAR(image.rgb_at(x, y).g, expected.g, 1e-5f * expected.g + 1e-7f) << x << ", " << y;
      EXPECT_NEAR(image.rgb_at(x, y).b, expected.b, 1e-5f * expected.b + 1e-7f) << x << ", " << y;
    }
}

}  // namespace sconce
