// SPDX-License-Identifier: Apache-2.0
// The ambient texture in a furnace: walls that shine as 1 and reflect a half see 2 from everywhere.
#include "detect/ambient_map.h"

#include <gtest/gtest.h>

#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

TEST(AmbientMap, Furnace) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.2f)), Vec3(0), Vec3(1), true);
  AmbientMap map(std::move(scene), 8);
  SyntheticHost host{map.world(), {{{Rgb(1), Rgb(), Rgb(0.5f)}}}};
  TransferParams params;
  params.gather = 1024, params.rays = 128, params.lights = 48, params.cluster = 64;
  map.start(host.renderer(), params);
  EXPECT_NEAR(map.detection().materials[0].response.reflectance.g, 0.5f, 1e-3f);
  ASSERT_TRUE(map.update());
  const TextureSpace& space = map.space();
  const std::vector<Rgb> reflected = map.reflected();
  ASSERT_EQ(reflected.size(), space.pixels());
  std::size_t around = 0;
  for (std::size_t i = 0; i < space.pixels(); ++i)
    if (space.covered[i]) {
      EXPECT_NEAR(map.texels()[i].g, 2, 0.06f) << i;
      EXPECT_NEAR(reflected[i].g, 1, 0.03f) << i;
    } else if (reflected[i].g > 0) {
      EXPECT_NEAR(reflected[i].g, 1, 0.03f) << i;
      ++around;
    }
  EXPECT_GT(around, 0u) << "filtering reads texels around faces";
  // A corner has a place in the texture: that of its face's texels.
  const auto coordinates = map.coordinates();
  for (std::size_t f = 0; f < space.triangles.size(); ++f) {
    const auto& uv = coordinates[space.triangles[f]];
    const Vec2 middle = (uv[0] + uv[1] + uv[2]) * Vec2(space.width, space.height) / 3.0f;
    EXPECT_TRUE(space.covered[static_cast<std::size_t>(middle.y) * static_cast<std::size_t>(space.width) +
                              static_cast<std::size_t>(middle.x)]);
  }
}

}  // namespace
}  // namespace sconce
