// SPDX-License-Identifier: Apache-2.0
// The seven scenes of the shared data, against what their README states.
#include <map>
#include <set>

#include "core/test_data.h"
#include "import/test_files.h"
#include "scene/groups.h"

namespace sconce {
namespace {

struct Group {
  const char* name;
  int lights;
  double area;   // m2, all lights together
  Rgb radiance;  // of one of them
};
struct Expected {
  const char* file;
  std::size_t triangles, vertices, nodes, materials, textures;
  double hfov, aspect;
  std::vector<Group> groups;
};

const std::vector<Expected> kScenes = {
    {"cornell-box", 36, 66, 9, 8, 0, 39.31, 1, {{"ceiling", 1, 0.1786, {17, 12, 4}}}},
    {"cornell-two-lights",
     38,
     70,
     10,
     9,
     0,
     39.31,
     1,
     {{"left", 1, 0.16, {20, 20, 20}}, {"right", 1, 0.15, {6, 14, 30}}}},
    {"modern-hall",
     28699,
     18714,
     32,
     20,
     3,
     70,
     16.0 / 9,
     {{"downlights", 5, 0.1724, Rgb(1.5f)},
      {"steps", 4, 0.07516, Rgb(1.5f)},
      {"skylight", 1, 39.82, Rgb(1.599f)},
      {"warm-panels", 2, 47.37, {4.575f, 3.591f, 1.55f}},
      {"lower-panel", 1, 19.49, Rgb(3.266f)}}},
    {"luxcore-kitchen",
     82884,
     150907,
     31,
     27,
     0,
     90,
     16.0 / 9,
     {{"worktop-pendant", 1, 0.317, {7.152f, 5.864f, 4.291f}},
      {"ceiling", 1, 1.082, {3.95f, 3.476f, 2.844f}},
      {"ceiling-spots", 1, 0.02982, {103.6f, 82.87f, 56.97f}},
      {"under-cabinet", 1, 0.01885, {55.42f, 49.88f, 44.34f}},
      {"window", 1, 11.43, {4, 4, 5.5f}}}},
    {"contemporary-bathroom",
     368110,
     227218,
     853,
     34,
     7,
     70,
     16.0 / 9,
     {{"window", 1, 2.606, Rgb(30)},
      {"mirror-lamps", 4, 0.09856, {8.91f, 7.306f, 5.346f}},
      {"ceiling", 2, 0.72, {3.239f, 3.077f, 2.85f}},
      {"plinth", 1, 0.06, {7.426f, 8.037f, 8.736f}}}},
    {"white-room",
     399417,
     245417,
     184,
     65,
     13,
     90,
     16.0 / 9,
     {{"bay-window", 3, 3.538, Rgb(13.75f)}, {"back-fill", 1, 5.891, Rgb(1.081f)}}},
    {"veach-ajar", 11108, 7474, 20, 13, 4, 60, 16.0 / 9, {{"room-behind-door", 1, 3.861, Rgb(1000)}}},
};

class GlbScenes : public testing::TestWithParam<Expected> {};

TEST_P(GlbScenes, HoldWhatTheReadmeSays) {
  const Expected& e = GetParam();
  const auto path = test_data() / "glb" / (std::string(e.file) + ".glb");
  SCONCE_NEEDS_DATA(path);
  Warnings warnings;
  Scene scene = import_scene(path, warnings.progress);
  EXPECT_EQ(scene.name, e.file);

  std::size_t triangles = 0, vertices = 0;
  for (const Mesh& mesh : scene.meshes) {
    triangles += mesh.triangles.size();
    vertices += mesh.positions.size();
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  }
  EXPECT_EQ(triangles, e.triangles);
  EXPECT_EQ(vertices, e.vertices);
  EXPECT_EQ(scene.instances.size() + scene.cameras.size(), e.nodes);
  EXPECT_EQ(scene.materials.size(), e.materials);
  EXPECT_EQ(scene.textures.size(), e.textures);

  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "main");
  EXPECT_NEAR(camera.aspect, e.aspect, 2e-3);
  EXPECT_NEAR(2 * std::atan(std::tan(camera.yfov / 2) * camera.aspect) * 180 / kPi, e.hfov, 0.02);

  assign_groups(scene, Grouping::automatic);
  std::map<std::string, int> lights;
  std::map<std::string, double> area;
  std::map<std::string, std::vector<Rgb>> radiance;
  for (const Instance& instance : scene.instances) {
    if (!scene.emits(instance)) continue;
    const std::string& group = scene[instance.group].name;
    const Mesh& mesh = scene[instance.mesh];
    ++lights[group];
    for (const Triangle& t : mesh.triangles)
      area[group] +=
          0.5 * static_cast<double>(glm::length(glm::cross(mesh.positions[t.v[1]] - mesh.positions[t.v[0]],
                                                           mesh.positions[t.v[2]] - mesh.positions[t.v[0]])));
    radiance[group].push_back(scene[mesh.material].emission);
    EXPECT_FALSE(scene[mesh.material].double_sided);
  }
  ASSERT_EQ(scene.groups.size(), e.groups.size());
  int count = 0;
  for (const Group& g : e.groups) {
    EXPECT_EQ(lights[g.name], g.lights) << g.name;
    EXPECT_NEAR(area[g.name], g.area, 2e-3 * g.area) << g.name;
    bool found = false;
    for (const Rgb& r : radiance[g.name])
      found |= std::abs(r.r - g.radiance.r) < 1e-3f * g.radiance.r &&
               std::abs(r.b - g.radiance.b) < 1e-3f * g.radiance.b;
    EXPECT_TRUE(found) << g.name;
    count += g.lights;
  }
  assign_groups(scene, Grouping::per_light);
  EXPECT_EQ(scene.groups.size(), static_cast<std::size_t>(count));
  assign_groups(scene, Grouping::one);
  EXPECT_EQ(scene.groups.size(), 1u);
  EXPECT_FALSE(warnings.any("missing"));
}

INSTANTIATE_TEST_SUITE_P(All, GlbScenes, testing::ValuesIn(kScenes), [](const auto& test) {
  std::string name = test.param.file;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace sconce
