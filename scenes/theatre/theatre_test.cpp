// SPDX-License-Identifier: Apache-2.0
#include "theatre.h"

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

const char* const kShipped = SCONCE_SOURCE_DIR "/scenes/theatre.glb";

TEST(Theatre, ShippedFileIsWhatTheGeneratorWrites) {
  const std::string shipped = read_file(kShipped);
  EXPECT_TRUE(shipped == write_glb(make_theatre())) << "run make_theatre scenes/theatre.glb";
  EXPECT_LE(shipped.size(), 3u << 20);
}

TEST(Theatre, HasTwentyGroupsOfTheStatedLumens) {
  Scene scene = import_scene(kShipped);
  assign_groups(scene, Grouping::named);
  EXPECT_EQ(scene.groups.size(), 20u);
  const World world = make_world(scene);
  std::map<std::string, double> lumens;
  for (std::size_t t = 0; t < world.size(); ++t)
    if (const Rgb luminous = scene[world.materials[t]].emission; !luminous.is_black())
      lumens[scene[scene[world.instances[t]].group].name] +=
          static_cast<double>(kPi) * static_cast<double>(luminance(luminous) * world.area(t));
  EXPECT_EQ(lumens.size(), 12u) << "lamps that are things";
  EXPECT_NEAR(lumens["house lights"], 11 * 900, 20);
  EXPECT_NEAR(lumens["chandelier"], 12 * 260, 5);
  EXPECT_NEAR(lumens["sky wash"], 11000, 20) << "a colour keeps the strength";
  std::map<std::string, int> spots;
  for (const Light& light : scene.lights) ++spots[scene[light.group].name];
  EXPECT_EQ(spots.size(), 8u);
  EXPECT_EQ(spots["back amber"], 4);
}

TEST(Theatre, SpotlightsHangFree) {
  const Scene scene = import_scene(kShipped);
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  for (const Light& light : scene.lights) {
    const Vec3 from(light.frame[3]), along = -glm::normalize(Vec3(light.frame[2]));
    const Hit hit = tracer.closest({from, along});
    ASSERT_TRUE(hit) << light.name;
    EXPECT_GT(glm::length(world.position(hit.triangle, hit.barycentric) - from), 2) << light.name;
  }
}

TEST(Theatre, IsClosed) {
  const Scene scene = import_scene(kShipped);
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const Vec3 starts[] = {{0, 3, 8},      {4, 2, 2},     {0, 3, -2.5f},
                         {-5.5f, 3, -5}, {0, 7.5f, -3}, {0.3f, 1.5f, -6}};
  const Strays strays = wander(scene, world, tracer, starts, 60000);
  EXPECT_LE(strays.lost, strays.shot / 100000);
  EXPECT_LE(strays.backs, strays.shot / 2000);
}

TEST(Theatre, OnlyClothAndLeavesAreDoubleSided) {
  const Scene scene = import_scene(kShipped);
  for (const Instance& instance : scene.instances) {
    const Material& m = scene[scene[instance.mesh].material];
    const bool thin = m.name == "curtain velvet" || m.name == "masking" || m.name == "leaf";
    EXPECT_EQ(m.double_sided, thin) << instance.name;
  }
}

}  // namespace
}  // namespace sconce::demo
