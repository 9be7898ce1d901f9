// SPDX-License-Identifier: Apache-2.0
// What is seen through panes.
#include <gtest/gtest.h>

#include "encode/half.h"
#include "picture/test_wall.h"

namespace sconce {
namespace {

using PicturePanes = Picture;

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
