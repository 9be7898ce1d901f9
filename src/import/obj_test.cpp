// SPDX-License-Identifier: Apache-2.0
#include "core/test_data.h"
#include "image/io.h"
#include "import/test_files.h"
#include "scene/world.h"

namespace sconce {
namespace {

std::size_t triangles_of(const Scene& scene) {
  std::size_t n = 0;
  for (const Instance& i : scene.instances) n += scene[i.mesh].triangles.size();
  return n;
}

TEST(Obj, GroupsMaterialsAndCoordinates) {
  const TemporaryFolder folder;
  folder.write("a b.mtl",
               "newmtl red\nKd 0.8 0.1 0.2\nmap_Kd -clamp on tile.png\nnewmtl lamp\nKd 0 0 0\nKe 17 12 4\n"
               "newmtl glass\nKd 1 1 1\nd 0.3\n");
  const auto path = folder.write(
      "box.obj",
      "mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
      "g floor\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\ng light\nusemtl lamp\nf 1 3 2\n"
      "g pane\nusemtl glass\nf 1 2 3\n");
  Warnings w;
  const Scene scene = import_obj(path, w.progress);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].name, "floor");
  EXPECT_EQ(scene.instances[1].name, "light");
  const Mesh& floor = scene[scene.instances[0].mesh];
  EXPECT_EQ(floor.triangles.size(), 2u);
  ASSERT_EQ(floor.texcoords.size(), 1u);
  EXPECT_EQ(floor.normals.at(0), Vec3(0, 0, 1));
  for (std::size_t i = 0; i < floor.positions.size(); ++i)  // row 0 of a picture is v = 0
    EXPECT_EQ(floor.texcoords[0][i], Vec2(floor.positions[i].x, 1 - floor.positions[i].y));
  const Material& red = scene[floor.material];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.base_color, Rgb(0.4f, 0.05f, 0.1f));  // its texture is missing: half
  EXPECT_TRUE(red.double_sided);
  EXPECT_TRUE(w.any("texture tile.png is left out"));
  const Material& lamp = scene[scene[scene.instances[1].mesh].material];
  EXPECT_EQ(lamp.emission, Rgb(17, 12, 4));
  EXPECT_FALSE(lamp.double_sided);
  const auto glass = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [](const Material& m) { return m.name == "glass"; });
  ASSERT_NE(glass, scene.materials.end());
  EXPECT_EQ(glass->alpha_mode, Material::Alpha::blend);
  EXPECT_LT(glass->alpha, 1);
  EXPECT_EQ(scene_files(path), std::vector<std::filesystem::path>{folder.path() / "a b.mtl"});
}

TEST(Obj, MissingMaterialFileIsNamed) {
  const TemporaryFolder folder;
  Warnings w;
  const Scene scene = import_scene(
      folder.write("x.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"), w.progress);
  EXPECT_EQ(triangles_of(scene), 1u);
  EXPECT_TRUE(w.any("gone.mtl is missing"));
  EXPECT_THROW(import_obj(folder.write("x.txt", "v 0 0 0")), NotMyFormat);
  EXPECT_THROW(import_scene(folder.write("empty.obj", "")), Error);
}

// Opacity in the red of a map of another size, beside a colour map and alone; many halves make a pane.
TEST(Obj, OpacityMapsCutOut) {
  const TemporaryFolder folder;
  write_png(folder / "leaf.png", {2, 1, 3, {10, 20, 30, 40, 50, 60}});
  write_png(folder / "shape.png", {4, 1, 3, {255, 0, 0, 0, 9, 9, 0, 9, 9, 255, 0, 0}});
  write_png(folder / "veil.png", {2, 1, 3, {128, 128, 128, 0, 0, 0}});
  folder.write(
      "x.mtl",
      "newmtl leaf\nKd 1 1 1\nmap_Kd leaf.png\nmap_d shape.png\nnewmtl veil\nKd 0.5 0.5 0.5\nmap_d veil.png\n"
      "newmtl lost\nKd 0.5 0.5 0.5\nmap_d gone.png\n");
  const auto path =
      folder.write("x.obj",
                   "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                   "usemtl leaf\nf 1/1 2/2 3/3\nusemtl veil\nf 1/1 2/2 3/3\nusemtl lost\nf 1/1 2/2 3/3\n");
  Warnings w;
  const Scene scene = import_scene(path, w.progress);
  const auto material = [&](const char* name) -> const Material& {
    return *std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& m) { return m.name == name; });
  };
  const Material& leaf = material("leaf");
  EXPECT_EQ(leaf.alpha_mode, Material::Alpha::mask);
  EXPECT_EQ(scene[leaf.base_color_texture.texture].pixels.data,
            (std::vector<unsigned char>{10, 20, 30, 255, 10, 20, 30, 0, 40, 50, 60, 0, 40, 50, 60, 255}));
  const Material& veil = material("veil");
  EXPECT_EQ(veil.alpha_mode, Material::Alpha::blend);
  EXPECT_EQ(scene[veil.base_color_texture.texture].pixels.data,
            (std::vector<unsigned char>{255, 255, 255, 128, 255, 255, 255, 0}));
  EXPECT_EQ(material("lost").alpha_mode, Material::Alpha::opaque);
  EXPECT_TRUE(w.any("gone.png is left out"));
  EXPECT_EQ(scene.textures.size(), 2u) << "maps that nothing shows are not kept beside the combined ones";
  EXPECT_EQ(scene_files(path).size(), 4u);  // what a bake's hash is of
}

/// The scene of an OBJ text.
Scene obj(const std::string& text, const Progress& progress = {}) {
  const TemporaryFolder folder;
  return import_obj(folder.write("x.obj", text), progress);
}

TEST(Obj, IndicesContinuationsAndLineEnds) {
  const std::string box = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto as_written = [](const Scene& scene) {
    std::vector<Vec3> out;
    for (const Triangle& t : scene.meshes.at(0).triangles)
      for (const uint32_t v : t.v) out.push_back(scene.meshes.at(0).positions[v]);
    return out;
  };
  const std::vector<Vec3> wanted = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  for (const char* face : {"f 1 2 3\n", "f -4 -3 -2", "f 1/ 2/ 3/ # that is all\n", "f 1 \\\n 2 3\n",
                           "f 1 \\\r\n 2 3\r\n", "\tf\t1\t2\t3 \r", "f 1//\t2// 3//\nf 1 2\nl 1 2 3\np 1\n"})
    EXPECT_EQ(as_written(obj(box + face)), wanted) << face;
  EXPECT_EQ(as_written(obj("f 1 2 3\n" + box)), wanted) << "what it is made of may follow";
  EXPECT_EQ(obj(box + "f 1 2 3\nf 1 3 4\n").meshes.at(0).positions.size(), 4u) << "corners are shared";
  EXPECT_EQ(
      obj("\xef\xbb\xbf" + box + "v 0 1 0 0.5\nf 1 2 3\nf 1 3 5\nf 1 3 4\n").meshes.at(0).positions.size(),
      4u)
      << "alike places, too";
}

// One part per name, material and kind of corner, wherever its faces stand.
TEST(Obj, PartsAndTheirNames) {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  const Scene scene = obj(head +
                          "f 1 2 3\nusemtl red\nf 1 2 3\ng a wall\nf 1 2 3\no b\nf 1 2 3\ng a wall\nf 3 2 1\n"
                          "f 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1 3\n");
  std::vector<std::string> names;
  for (const Instance& i : scene.instances) names.push_back(i.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x", "red", "a wall", "b", "a wall", "a wall"}));
  EXPECT_EQ(scene.meshes[2].triangles.size(), 3u) << "the last face has half of its coordinates: none";
  EXPECT_EQ(scene.meshes[4].texcoords.at(0), (std::vector<Vec2>(3, {0, 1})));
  EXPECT_TRUE(obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/2 3/3/3\n").meshes.at(0).texcoords.empty())
      << "some programs write indices into nothing";
  EXPECT_EQ(scene.meshes[5].normals, (std::vector<Vec3>(3, {0, 0, 1})));
}

TEST(Obj, WhatIsWrongIsNamedWithItsLine) {
  const auto said = [](const std::string& text) {
    const std::string error = error_of([&] { obj("# one\nv 0 0 0\nv 1 0 \\\n0\nv 0 1 0\n" + text); });
    return error.substr(error.find("x.obj") + 5);
  };
  EXPECT_EQ(said("f 1 2 4"), ":6: index 4 is out of range (allowed: 1 to 3)");
  EXPECT_EQ(said("\nf 1 2 0"), ":7: index 0 is out of range (allowed: 1 to 3)");
  EXPECT_EQ(said("vn 0 0 1\nf 1//1 2//2 3"), ":7: index 2 is out of range (allowed: 1 to 1)");
  EXPECT_EQ(said("f 1 2 -4"), ":6: index -4 is out of range (allowed: -3 to -1)");
  EXPECT_EQ(said("f 1 2 x"), ":6: 'x' is no corner of a face (allowed: v, v/vt, v//vn, v/vt/vn)");
  EXPECT_EQ(said("f 1 2 //"), ":6: '//' is no corner of a face (allowed: v, v/vt, v//vn, v/vt/vn)");
  EXPECT_EQ(said("f 1 2 3///"), ":6: '3///' is no corner of a face (allowed: v, v/vt, v//vn, v/vt/vn)");
  EXPECT_EQ(said("v 0,5 0 0"), ":6: '0,5' is no number");
  EXPECT_EQ(said("v 0 0 \xf9\x1b"), ":6: what stands there is no number");
  EXPECT_EQ(said("v 0 0"), ":6: has 2 numbers (allowed: 3)");
  EXPECT_EQ(said("f 1 2"), ": has no faces");
}

// What programs write that divided by 0.
TEST(Obj, TrianglesWithoutAPlaceAreLeftOut) {
  const TemporaryFolder folder;
  Warnings w;
  const Scene scene = import_scene(folder.write("x.obj",
                                                "v nan 0 0\nv -1.#IND 0 0\nv 0 -nan(ind) 0\nv 1e999 0 0\n"
                                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan nan nan\n"
                                                "f 1 6 7\nf 2 6 7\nf 3 6 7\nf 4 6 7\nf 5//1 6//1 7//1\n"),
                                   w.progress);
  EXPECT_EQ(triangles_of(scene), 1u);
  EXPECT_TRUE(w.any("4 triangles with positions that are not numbers"));
}

TEST(Obj, FreeFormSurfacesAndUnknownMaterialsAreNamed) {
  const TemporaryFolder folder;
  folder.write("x.mtl", "newmtl a\n");
  Warnings w;
  const Scene scene = import_scene(
      folder.write("x.obj",
                   "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl b\nf 1 2 3\nsurf 0 1 0 1 1 2 3\n"),
      w.progress);
  EXPECT_TRUE(w.any("material 'b' is in none of its material files"));
  EXPECT_TRUE(w.any("free-form curves and surfaces are left out"));
  EXPECT_EQ(scene.materials.at(0).base_color, Rgb(0.6f));
}

TEST(Obj, PropertiesBeforeTheFirstMaterialAreLeftOut) {
  const TemporaryFolder folder;
  folder.write("x.mtl", "# a\rKd 1 0 0\nmap_Kd x.png\nnewmtl\nd 1\nnewmtl a\r\nKd 0.5 0.25 0\n");
  const Scene scene =
      import_scene(folder.write("x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
  EXPECT_EQ(scene[scene.meshes.at(0).material].base_color, Rgb(0.5f, 0.25f, 0));
}

TEST(Obj, CornellBoxOfMcGuire) {
  const auto path = test_data() / "scenes/cornell-mcguire/CornellBox-Original.obj";
  SCONCE_NEEDS_DATA(path);
  Warnings w;
  const Scene scene = import_scene(path, w.progress);
  EXPECT_EQ(make_world(scene).size(), 36u);
  int lamps = 0;
  for (const Instance& i : scene.instances) {
    if (!scene.emits(i)) continue;
    ++lamps;
    EXPECT_EQ(scene[scene[i.mesh].material].emission, Rgb(17, 12, 4));
    EXPECT_EQ(i.name, "light");
  }
  EXPECT_EQ(lamps, 1);
}

TEST(Obj, AllCornellBoxesAndTinyobj) {
  for (const char* folder : {"scenes/cornell-mcguire", "conformance/tinyobj"}) {
    const auto root = test_data() / folder;
    SCONCE_NEEDS_DATA(root);
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
      if (entry.path().extension() != ".obj") continue;
      const std::string stem = entry.path().stem().string();
      const std::string error = error_of([&] { import_scene(entry.path()); });
      const bool no_faces = stem == "points-prim" || stem == "line-prim";
      EXPECT_EQ(error.empty(), !no_faces) << entry.path() << error;
    }
  }
}

}  // namespace
}  // namespace sconce
