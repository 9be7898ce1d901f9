// SPDX-License-Identifier: Apache-2.0
#include "core/test_data.h"
#include "import/test_files.h"
#include "scene/world.h"

namespace sconce {
namespace {

namespace fs = std::filesystem;

Vec3 direction(const Mat4& frame) {
  return -Vec3(frame[2]);
}

const Light& light(const Scene& scene, const std::string& name) {
  for (const Light& l : scene.lights)
    if (l.name == name) return l;
  throw Error(name, "is no lamp of the scene");
}

TEST(AssimpFormats, StlAndPlyAreTriangles) {
  const TemporaryFolder folder;
  Warnings w;
  const Scene stl =
      import_scene(folder.write("a.stl",
                                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
                                "vertex 0 1000 0\nendloop\nendfacet\nendsolid a\n"),
                   w.progress);
  ASSERT_EQ(stl.instances.size(), 1u);
  EXPECT_EQ(stl.meshes.at(0).triangles.size(), 1u);
  EXPECT_TRUE(w.any("STL has no units: its 1000 x 1000 x 0 are taken as metres; [scene] unit in a.toml"));
  const Scene ply = import_scene(folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "4 0 1 2 3\n"));
  EXPECT_EQ(ply.meshes.at(0).triangles.size(), 2u);
  for (const Scene* scene : {&stl, &ply})
    EXPECT_EQ((*scene)[scene->meshes.at(0).material].base_color, Rgb(0.6f)) << "white would lose no light";
}

TEST(AssimpFormats, UnitAndUpOfTheSideFile) {
  const TemporaryFolder folder;
  const fs::path path =
      folder.write("a.stl",
                   "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
                   "vertex 0 0 2000\nendloop\nendfacet\nendsolid a\n");
  folder.write("a.toml", "[scene]\nunit = \"mm\"\nup = \"z\"\n");
  Warnings w;
  const Bounds bounds = make_world(import_scene(path, w.progress)).bounds;
  EXPECT_FALSE(w.any("no units"));
  EXPECT_NEAR(bounds.hi.x, 1, 1e-6);
  EXPECT_NEAR(bounds.hi.y, 2, 1e-6);
  EXPECT_NEAR(bounds.hi.z, 0, 1e-6);
  folder.write("a.toml", "[scene]\nunit = \"parsec\"\n");
  EXPECT_NE(error_of([&] { import_scene(path); }).find("a.toml:2: [scene] unit"), std::string::npos);
}

TEST(AssimpFormats, CentimetresAndAxesOfFbx) {
  // Blender wrote a Cornell-like room in centimetres.
  const Bounds room = make_world(import_scene(test_data() / "scenes/bakinglab/WhiteRoom.fbx")).bounds;
  EXPECT_NEAR(room.hi.x - room.lo.x, 0.2, 0.01);
  EXPECT_NEAR(room.lo.y, 0, 1e-3);
}

TEST(AssimpFormats, LampsHaveNoUnitsAndSayIt) {
  Warnings w;
  const Scene scene =
      import_assimp(test_data() / "lights/ufbx/motionbuilder_lights_7700_ascii.fbx", w.progress);
  EXPECT_TRUE(w.any("no photometric units"));
  EXPECT_NEAR(luminance(light(scene, "PointConstant").intensity), 683 / (4 * kPi), 1e-3);
  EXPECT_TRUE(std::holds_alternative<PointLight>(light(scene, "PointConstant").shape));
  const Light& spot = light(scene, "SpotConstant");
  ASSERT_TRUE(std::holds_alternative<SpotLight>(spot.shape));
  const SpotLight& cone = std::get<SpotLight>(spot.shape);
  EXPECT_LT(cone.inner, cone.outer);
}

// By the square of the distance is what light does; other decays are named, suns have none.
TEST(AssimpFormats, DecaysThatLightHasNotAreNamed) {
  const auto said = [](const char* file, const char* part) {
    Warnings w;
    import_assimp(test_data() / "lights" / file, w.progress);
    return w.any(part);
  };
  EXPECT_TRUE(
      said("ufbx/motionbuilder_lights_7700_ascii.fbx",
           "the decay of 'PointLinear', 'PointCubic', 'SpotLinear', 'SpotCubic' is not by the square"));
  EXPECT_TRUE(said("magnum/light.dae", "the decay of 'Spot', 'Point' is not by the square"));
  EXPECT_FALSE(said("assimp/lights.dae", "the decay of"));
}

// assimp would make a mesh of the nodes, which nobody wrote and which has no area.
TEST(AssimpFormats, LampsAloneAreNoGeometry) {
  for (const char* file : {"magnum/light.dae", "magnum/lights.fbx", "assimp/lights.dae"}) {
    const Scene scene = import_scene(test_data() / "lights" / file);
    EXPECT_TRUE(scene.instances.empty()) << file;
    EXPECT_GT(scene.lights.size(), 2u) << file;
  }
}

TEST(AssimpFormats, AreaLampsThatLoseTheirSizeAreNamed) {
  Warnings w;
  const Scene scene = import_assimp(test_data() / "lights/magnum/lights.fbx", w.progress);
  EXPECT_TRUE(w.any("area lamp 'areaLight1' has lost its size"));
  EXPECT_TRUE(std::holds_alternative<PointLight>(light(scene, "areaLight1").shape));
}

TEST(AssimpFormats, ColladaLampsPointWhereTheyDo) {
  Warnings w;
  const Scene scene = import_assimp(test_data() / "lights/assimp/lights.dae", w.progress);
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_TRUE(std::holds_alternative<SunLight>(light(scene, "Sun").shape));
  const Light& spot = light(scene, "Spot");  // z is up there
  EXPECT_LT(glm::length(Vec3(spot.frame[3]) - Vec3(8.888217f, 5.336025f, 5.016863f)), 1e-4);
  EXPECT_LT(glm::length(direction(spot.frame) - Vec3(0, -1, 0)), 1e-5);
  EXPECT_TRUE(w.any("'Hemi' is ambient light"));
}

TEST(AssimpFormats, TexturesOfDosAreFoundAndHashed) {
  const fs::path cube = test_data() / "conformance/assimp-3ds/cube_with_diffuse_texture.3DS";
  Warnings w;
  const Scene scene = import_scene(cube, w.progress);
  EXPECT_FALSE(w.any("is left out"));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene_files(cube), std::vector<fs::path>{cube.parent_path() / "test.png"});
}

TEST(AssimpFormats, Every3dsOfAssimpIsReadOrRefusedInOneLine) {
  std::size_t read = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test_data() / "conformance/assimp-3ds")) {
    if (entry.path().extension() != ".3ds" && entry.path().extension() != ".3DS") continue;
    try {
      import_assimp(entry.path());
      ++read;
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()), std::string::npos);
    }
  }
  EXPECT_EQ(read, 9u);
  EXPECT_EQ(refused, 1u);
  EXPECT_THROW(import_assimp("x.glb"), NotMyFormat);
}

}  // namespace
}  // namespace sconce
