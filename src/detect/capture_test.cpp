// SPDX-License-Identifier: Apache-2.0
#include "detect/capture.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TEST(FaceCells, DoNotMeetAndHoldWholePixels) {
  std::vector<uint32_t> triangles;
  std::vector<int> texels;
  for (uint32_t t = 0; t < 200; ++t)
    triangles.push_back(t), texels.push_back(1 + static_cast<int>(t * 7 % 13));
  const TextureSpace space = face_cells(triangles, texels);
  std::vector<int> owner(space.pixels(), -1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    int count = 0;
    each_pixel(space, i, [&](std::size_t pixel) {
      EXPECT_EQ(owner[pixel], -1);
      owner[pixel] = static_cast<int>(i);
      ++count;
    });
    EXPECT_EQ(count, texels[i] * (texels[i] + 1) / 2);
    const auto& [a, b, c] = space.corners[i];
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0) << "mirrored";
  }
  // No pixel beside a face's is another face's: filtering and rounding cannot mix them.
  for (std::size_t p = 1; p < owner.size(); ++p)
    if (p % static_cast<std::size_t>(space.width) != 0 && owner[p] >= 0 && owner[p - 1] >= 0) {
      EXPECT_EQ(owner[p], owner[p - 1]);
    }
  EXPECT_THROW(face_cells(triangles, std::vector<int>(200, 5000)), Error);
}

TEST(FaceCells, SpreadOverAScreen) {
  const std::vector<uint32_t> triangles{4, 5, 6, 7, 8};
  const TextureSpace here = spread_cells(triangles, 8, 1024, 0, 0),
                     there = spread_cells(triangles, 8, 1024, 1, 0.5f);
  EXPECT_EQ(here.width, 1023);  // three cells of 341 pixels
  EXPECT_EQ(here.triangles, triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    int count = 0;
    each_pixel(there, i, [&](std::size_t pixel) {
      EXPECT_TRUE(there.covered[pixel]);
      ++count;
    });
    EXPECT_EQ(count, 8 * 9 / 2);
    // One cell on, and half of the room of 332 pixels; the last one comes first.
    EXPECT_EQ(there.corners[i][0], here.corners[(i + 1) % 5][0] + Vec2(166));
  }
}

TEST(FaceCells, LargeFacesGetMore) {
  Scene scene;
  const auto grey = add_material(scene, "grey", Rgb(0.5f));
  add_quad(scene, "floor", grey, Vec3(0), Vec3(0, 0, 4), Vec3(4, 0, 0));
  add_quad(scene, "tile", grey, Vec3(0), Vec3(0.1f, 0, 0), Vec3(0, 0.1f, 0));
  const World world = make_world(scene);
  EXPECT_EQ(texels_by_area(world, std::vector<uint32_t>{0, 1, 2, 3}, 0.25f, 64),
            (std::vector<int>{16, 16, 1, 1}));
}

TEST(FaceCells, EveryPointOfAFaceHasItsPixels) {
  const TextureSpace space =
      face_cells(std::vector<uint32_t>{0, 1, 2, 3, 4}, std::vector<int>{6, 1, 3, 1, 4});
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<std::size_t> own;
    each_pixel(space, i, [&](std::size_t pixel) { own.push_back(pixel); });
    for (int k = 0; k <= 55; ++k) {
      const Vec2 w(static_cast<float>(k % 11) / 10, static_cast<float>(k / 11) / 5);
      if (w.x + w.y > 1) continue;
      const auto& [a, b, c] = space.corners[i];
      const auto blend = blend_at(space, a + w.x * (b - a) + w.y * (c - a));
      ASSERT_TRUE(blend);
      float sum = 0;
      for (std::size_t p = 0; p < 4; ++p) {
        sum += blend->weights[p];
        if (blend->weights[p] > 0) {
          EXPECT_NE(std::find(own.begin(), own.end(), blend->pixels[p]), own.end());
        }
      }
      EXPECT_NEAR(sum, 1, 1e-6f);
    }
  }
}

// 32. A value of 8 survives floats and clips codes.
TEST(Capture, OverRangeLight) {
  Scene scene;
  add_quad(scene, "wall", add_material(scene, "white", Rgb(1)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(0), Rgb(0), Rgb(0.5f)}}}};
  host.unit = 1;
  host.attenuation = false;
  host.lamps = {{Vec3(0.5f, 0.5f, 1e4f), Rgb(16)}};
  const TextureSpace space = face_cells(std::vector<uint32_t>{0, 1}, std::vector<int>{4, 4});
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  for (const TargetFormatRow& row : kTargetFormats) {
    host.format = row.format;
    const Captured captured = capture(host.renderer(), space, request, row.name.data());
    std::size_t clipped = 0, pixels = 0;
    each_pixel(space, 0, [&](std::size_t pixel) {
      ++pixels;
      clipped += captured.is_clipped(pixel) ? 1 : 0;
      EXPECT_NEAR(captured.light[pixel].g, row.format == TargetFormat::linear ? 8 : 1, 1e-3f);
    });
    EXPECT_EQ(clipped, row.format == TargetFormat::linear ? 0 : pixels);
  }
}

// A dark scene is not a renderer that draws nothing.
TEST(Capture, DarkOrNotDrawn) {
  Scene scene;
  add_quad(scene, "wall", add_material(scene, "white", Rgb(1)), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(0), Rgb(0), Rgb(0.5f)}}}};
  const TextureSpace space = face_cells(std::vector<uint32_t>{0, 1}, std::vector<int>{4, 4});
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  const Captured dark = capture(host.renderer(), space, request, "direct light");
  EXPECT_EQ(dark.light[0].max(), 0);
  EXPECT_EQ(dark.cost.draws, 2u);
  const HostRenderer idle{[](const DrawRequest& r) {
    return Drawing{r.width, r.height, std::vector<float>(3 * r.pixels(), r.background), {}};
  }};
  try {
    capture(idle, space, request, "direct light");
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "the renderer's drawing of direct light: shows none of the faces: white stays white");
  }
}

// methods.md 1B: the two decodings differ by -31 % at code 32 and +0.9 % at 200.
TEST(Capture, Codes) {
  const auto ratio = [](uint8_t code) {
    return decode_code(TargetFormat::power8, code) / decode_code(TargetFormat::srgb8, code);
  };
  EXPECT_NEAR(ratio(32), 0.69f, 0.005f);
  EXPECT_NEAR(ratio(200), 1.009f, 0.0005f);
}

}  // namespace
}  // namespace sconce
