// SPDX-License-Identifier: Apache-2.0
#include "bathroom.h"

#include <gtest/gtest.h>

#include <map>

#include "core/files.h"
#include "glb_writer.h"
#include "import/import.h"
#include "scene/groups.h"
#include "scene/world.h"
#include "wanderers.h"

namespace sconce::demo {
namespace {

const char* const kShipped = SCONCE_SOURCE_DIR "/scenes/bathroom.glb";

TEST(Bathroom, ShippedFileIsWhatTheGeneratorWrites) {
  // Not EXPECT_EQ: nobody wants to see megabytes of difference.
  EXPECT_TRUE(read_file(kShipped) == write_glb(make_bathroom())) << "run make_bathroom scenes/bathroom.glb";
}

TEST(Bathroom, IsOfTheStatedSize) {
  const Scene scene = import_scene(kShipped);
  EXPECT_EQ(scene.instances.size(), make_bathroom().instances.size());
  const World world = make_world(scene);
  EXPECT_GE(world.size(), 20000u);
  EXPECT_LE(world.size(), 60000u);
  EXPECT_LE(read_file(kShipped).size(), 6u << 20);
}

TEST(Bathroom, HasFourGroupsOfTheStatedLumens) {
  Scene scene = import_scene(kShipped);
  assign_groups(scene, Grouping::named);
  const World world = make_world(scene);
  std::map<std::string, double> lumens;
  for (std::size_t t = 0; t < world.size(); ++t) {
    const Rgb luminous = scene[world.materials[t]].emission;
    if (luminous.is_black()) continue;
    EXPECT_FALSE(scene[world.materials[t]].double_sided);
    lumens[scene[scene[world.instances[t]].group].name] +=
        static_cast<double>(kPi) * static_cast<double>(luminance(luminous) * world.area(t));
  }
  ASSERT_EQ(lumens.size(), 4u);
  EXPECT_NEAR(lumens["ceiling"], 2000, 2);
  EXPECT_NEAR(lumens["mirror"], 1200, 2);
  EXPECT_NEAR(lumens["shower"], 600, 2);
  EXPECT_NEAR(lumens["window"], 4000, 4);
}

TEST(Bathroom, MaterialsAreMattAndKeepWithinRealAlbedo) {
  for (const Material& m : import_scene(kShipped).materials) {
    EXPECT_EQ(m.metallic, 0) << m.name;
    if (!m.base_color_texture.texture.valid()) {
      EXPECT_LE(m.base_color.max(), 0.85f) << m.name;
    }
  }
}

/// Rays that wander through the room: none gets out, and hardly any finds the back of something.
TEST(Bathroom, IsClosed) {
  const Scene scene = import_scene(kShipped);
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const Vec3 starts[] = {{1.6f, 1.3f, 1.6f}, {2.25f, 1.5f, 3.3f}, {2.95f, 1.6f, -0.4f}, {0.5f, 2.2f, 1.0f}};
  const Strays strays = wander(scene, world, tracer, starts, 100000);
  EXPECT_LE(strays.lost, strays.shot / 100000);
  EXPECT_LE(strays.backs, strays.shot / 5000);
}

/// What may be seen from both sides: leaves and towels. Every other mesh is a solid or a wall: its front is
/// outside.
TEST(Bathroom, OnlyThinSheetsAreDoubleSided) {
  const Scene scene = import_scene(kShipped);
  for (const Instance& instance : scene.instances) {
    const Material& m = scene[scene[instance.mesh].material];
    const bool thin = m.name.find("towel") != std::string::npos || m.name.find("leaf") != std::string::npos;
    EXPECT_EQ(m.double_sided, thin) << instance.name;
  }
}

TEST(Bathroom, HasItsCameras) {
  const Scene scene = import_scene(kShipped);
  ASSERT_GE(scene.cameras.size(), 3u);
  EXPECT_EQ(scene.cameras[0].name, "main");
}

}  // namespace
}  // namespace sconce::demo
