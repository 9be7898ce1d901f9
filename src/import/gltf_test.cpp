// SPDX-License-Identifier: Apache-2.0
// Geometry: accessors, primitives, nodes, files; each on a file made by the test.
#include "import/test_files.h"

namespace sconce {
namespace {

Scene import_text(const std::string& json, const Progress& progress = {}) {
  const TemporaryFolder folder;
  return import_gltf(folder.write("scene.gltf", json), progress);
}

std::string error_text(const std::string& json) {
  return error_of([&] { import_text(json); });
}

std::string mesh(const std::string& attributes, const std::string& more = {}) {
  return "\"meshes\":[{\"primitives\":[{\"attributes\":{" + attributes + "}" + more +
         "}]}],\"nodes\":[{\"mesh\":0}]";
}

TEST(GltfAccessors, ComponentTypesAndNormalisation) {
  const auto u = [](float x, float y) { return Vec2(x, y); };
  GltfBuilder b = triangle();
  const int view8 = b.view<unsigned char>({0, 255, 0, 0, 51, 102, 0, 0, 255, 0, 0, 0}, 4);
  b.accessor(view8, 5121, "VEC2", 3, ",\"normalized\":true");
  b.accessor(b.view<unsigned short>({0, 65535, 13107, 0, 1, 2}), 5123, "VEC2", 3, ",\"normalized\":true");
  b.accessor(b.view<signed char>({-128, 127, 0, 0, 0, -127, 0, 0, 1, 2, 0, 0}, 4), 5120, "VEC2", 3,
             ",\"normalized\":true");
  b.accessor(b.view<short>({-32768, 32767, 0, 16384, 1, 2}), 5122, "VEC2", 3, ",\"normalized\":true");
  b.accessor(view8, 5121, "VEC2", 3);
  const Scene scene = import_text(b.json(
      mesh(R"("POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2,"TEXCOORD_2":3,"TEXCOORD_3":4,"TEXCOORD_4":5)")));
  const auto& uv = scene.meshes.at(0).texcoords;
  ASSERT_EQ(uv.size(), 5u);
  EXPECT_EQ(uv[0], (std::vector<Vec2>{u(0, 1), u(0.2f, 0.4f), u(1, 0)}));
  EXPECT_EQ(uv[1][1], u(0.2f, 0));
  EXPECT_EQ(uv[2][0], u(-1, 1));
  EXPECT_EQ(uv[2][1], u(0, -1));
  EXPECT_EQ(uv[3][0], u(-1, 1));
  EXPECT_NEAR(uv[3][1].y, 16384.0f / 32767, 1e-6);
  EXPECT_EQ(uv[4][1], u(51, 102));
}

TEST(GltfAccessors, StrideOffsetAndSparse) {
  GltfBuilder b;
  // Positions interleaved with something else, from the second element on.
  const int view = b.view<float>({9, 9, 9, 9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9}, 16);
  b.accessor(view, 5126, "VEC3", 3, ",\"byteOffset\":16");
  const int at = b.view<unsigned char>({1});
  const int to = b.view<float>({5, 6, 7});
  const std::string sparse = ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(at) +
                             ",\"componentType\":5121},\"values\":{\"bufferView\":" + std::to_string(to) +
                             "}}";
  b.accessor(view, 5126, "VEC3", 3, ",\"byteOffset\":16" + sparse);
  b.accessor(-1, 5126, "VEC3", 3, sparse);
  const Scene scene = import_text(b.json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}},
      {"attributes":{"POSITION":1}},{"attributes":{"POSITION":2}}]}],"nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(scene.meshes.at(1).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
  EXPECT_EQ(scene.meshes.at(2).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}}));
}

TEST(GltfAccessors, OutOfRangeIsAnErrorWithItsPlace) {
  GltfBuilder b = triangle();
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":7)"))).find("POSITION: accessor 7 is out of range"),
            std::string::npos);
  b.accessor(0, 5126, "VEC3", 4);
  b.accessor(0, 5126, "VEC2", 3);
  b.accessor(9, 5126, "VEC3", 3);
  b.scalars({0, 1, 3});
  b.accessor(0, 5126, "VEC3", 3, ",\"byteOffset\":4000000000");
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":1)"))).find("reaches beyond its bufferView"),
            std::string::npos);
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":2)"))).find("VEC3"), std::string::npos);
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":3)"))).find("bufferView 9 is out of range"),
            std::string::npos);
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":0)", ",\"indices\":4"))).find("vertex 3 is out of range"),
            std::string::npos);
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":5)"))).find("reaches beyond"), std::string::npos);
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":0)", ",\"material\":0"))).find("material: index 0"),
            std::string::npos);
  EXPECT_NE(error_text(b.json("\"nodes\":[{\"mesh\":3}]")).find("mesh: index 3"), std::string::npos);
}

TEST(GltfMeshes, TrianglesStripsFansAndTheRest) {
  GltfBuilder b;
  b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0});
  b.scalars({4, 3, 2, 1, 0});
  const Scene scene = import_text(b.json(R"("meshes":[{"primitives":[
      {"attributes":{"POSITION":0},"mode":5},{"attributes":{"POSITION":0},"mode":6},
      {"attributes":{"POSITION":0},"mode":4,"indices":1}]}],"nodes":[{"mesh":0}])"));
  const auto list = [&](std::size_t m) {
    std::vector<std::array<uint32_t, 3>> out;
    for (const Triangle& t : scene.meshes.at(m).triangles) out.push_back(t.v);
    return out;
  };
  using List = std::vector<std::array<uint32_t, 3>>;
  EXPECT_EQ(list(0), (List{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(list(1), (List{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_EQ(list(2), (List{{4, 3, 2}}));

  Warnings w;
  const Scene lines = import_text(b.json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":1},
      {"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])"),
                                  w.progress);
  EXPECT_EQ(lines.meshes.size(), 1u);
  EXPECT_TRUE(w.any("meshes[0].primitives[0]: holds points or lines"));
  EXPECT_NE(error_text(b.json(mesh(R"("POSITION":0)", ",\"mode\":7"))).find("mode 7"), std::string::npos);
}

TEST(GltfNodes, TransformsExtrasAndGroups) {
  const GltfBuilder b = triangle();
  const Scene scene = import_text(b.json(std::string(kTriangleMesh) + R"(,"nodes":[
      {"name":"root","translation":[1,2,3],"rotation":[0,0,0.7071068,0.7071068],"scale":[2,1,1],"children":[1,2,3]},
      {"name":"child","mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]},
      {"name":"group:left","mesh":0,"extras":{"lightmap_scale":2.5},"children":[4]},
      {"name":"group:left","mesh":0,"extras":{"light_group":"right","light":"the one"}},
      {"name":"under","mesh":0}],"scenes":[{"nodes":[0]}])"));
  ASSERT_EQ(scene.instances.size(), 4u);
  // x of the child: doubled, turned to y, then moved.
  const Vec3 p(scene.instances[0].transform * glm::vec4(1, 0, 0, 1));
  EXPECT_NEAR(p.x, 1, 1e-5);
  EXPECT_NEAR(p.y, 4, 1e-5);
  EXPECT_NEAR(p.z, 8, 1e-5);
  EXPECT_EQ(scene.instances[0].group_name, "");
  EXPECT_EQ(scene.instances[1].group_name, "left");
  EXPECT_EQ(scene.instances[1].lightmap_scale, 2.5f);
  EXPECT_EQ(scene.instances[2].name, "under");
  EXPECT_EQ(scene.instances[2].group_name, "left");  // comes down from the parent
  EXPECT_EQ(scene.instances[2].lightmap_scale, 2.5f);
  EXPECT_EQ(scene.instances[3].group_name, "right");
  EXPECT_EQ(scene.instances[3].light_name, "the one");
}

TEST(GltfNodes, WhichSceneAndBrokenTrees) {
  const GltfBuilder b = triangle();
  const std::string nodes =
      std::string(kTriangleMesh) +
      R"(,"nodes":[{"name":"a","mesh":0,"children":[1]},{"name":"b","mesh":0},{"name":"c","mesh":0}])";
  const auto names = [&](const std::string& rest) {
    std::string out;
    for (const Instance& i : import_text(b.json(nodes + rest)).instances) out += i.name;
    return out;
  };
  EXPECT_EQ(names(""), "abc");
  EXPECT_EQ(names(R"(,"scenes":[{"nodes":[2]},{"nodes":[0]}])"), "c");
  EXPECT_EQ(names(R"(,"scenes":[{"nodes":[2]},{"nodes":[0]}],"scene":1)"), "ab");
  EXPECT_NE(error_text(b.json(nodes + R"(,"scenes":[{"nodes":[9]}])")).find("index 9"), std::string::npos);
  EXPECT_NE(error_text(b.json(nodes + R"(,"scenes":[{"nodes":[0,1]}])")).find("reached twice"),
            std::string::npos);
  EXPECT_NE(error_text(b.json(std::string(kTriangleMesh) +
                              R"(,"nodes":[{"children":[1]},{"children":[0]}],"scenes":[{"nodes":[0]}])"))
                .find("reached twice"),
            std::string::npos);
}

TEST(GltfNodes, Cameras) {
  Warnings w;
  const GltfBuilder b = triangle();
  const Scene scene =
      import_text(b.json(std::string(kTriangleMesh) +
                         R"(,"nodes":[{"mesh":0},{"name":"eye","camera":0,"translation":[0,1,0]},
      {"camera":1},{"name":"plan","camera":2}],"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":1.5,"znear":0.1}},
      {"name":"wide","type":"perspective","perspective":{"yfov":1.5,"znear":0.1}},
      {"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":10,"znear":0.1}}])"),
                  w.progress);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_FLOAT_EQ(scene.cameras[0].yfov, 0.5f);
  EXPECT_FLOAT_EQ(scene.cameras[0].aspect, 1.5f);
  EXPECT_EQ(scene.cameras[0].frame[3].y, 1);
  EXPECT_EQ(scene.cameras[1].name, "wide");
  EXPECT_TRUE(w.any("'plan' is orthographic"));
}

TEST(GltfFiles, ExternalBuffersMissingAndShort) {
  const TemporaryFolder folder;
  const GltfBuilder b = triangle();
  const std::string json = b.json(std::string(kTriangleMesh) + R"(,"nodes":[{"mesh":0}])", "my%20data.bin");
  const auto path = folder.write("scene.gltf", json);
  Warnings w;
  EXPECT_TRUE(import_gltf(path, w.progress).meshes.empty());
  EXPECT_TRUE(w.any("my data.bin is missing"));
  EXPECT_TRUE(w.any("meshes[0].primitives[0]: lies in a missing buffer"));
  EXPECT_TRUE(scene_files(path).empty());

  const std::string bytes(b.bytes().begin(), b.bytes().end());
  folder.write("my data.bin", bytes);
  EXPECT_EQ(import_gltf(path).meshes.size(), 1u);
  EXPECT_EQ(scene_files(path), std::vector<std::filesystem::path>{folder.path() / "my data.bin"});
  folder.write("my data.bin", bytes.substr(1));
  EXPECT_NE(error_of([&] { import_gltf(path); }).find("cut short"), std::string::npos);
}

// A GLB's lengths are of 32 bits: what it says is behind 4 GiB is not there, and what lies behind its end is
// nobody's.
TEST(GltfFiles, BeyondFourGigabytes) {
  const TemporaryFolder folder;
  std::string json = R"({"asset": {"version": "2.0"}})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto glb = [&](uint32_t length, uint32_t chunk) {
    std::string bytes = "glTF";
    for (const uint32_t word : {2u, length, chunk, 0x4e4f534au})
      bytes.append(reinterpret_cast<const char*>(&word), 4);
    const std::string path = folder.write("big.glb", bytes + json);
    std::filesystem::resize_file(path, std::uintmax_t{5} << 30);  // sparse
    return path;
  };
  const auto size = static_cast<uint32_t>(json.size());
  EXPECT_TRUE(import_gltf(glb(20 + size, size)).meshes.empty());
  EXPECT_NE(error_of([&] { import_gltf(glb(0xfffffff0u, 0xffffffffu)); }).find("reaches beyond the file"),
            std::string::npos);
}

TEST(GltfFiles, VersionsExtensionsAndOtherFormats) {
  const GltfBuilder b = triangle();
  const std::string body = std::string(kTriangleMesh) + R"(,"nodes":[{"mesh":0}])";
  EXPECT_EQ(
      error_text(b.json(body + R"(,"extensionsRequired":["KHR_mesh_quantization","KHR_texture_transform"])")),
      "");
  const std::string error = error_text(b.json(body + R"(,"extensionsRequired":["KHR_no_such_thing","X_y"])"));
  EXPECT_NE(error.find("KHR_no_such_thing, X_y"), std::string::npos);
  Warnings w;
  import_text(b.json(body + R"(,"extensionsUsed":["KHR_materials_unlit","KHR_materials_transmission",
                             "KHR_materials_sheen"])"),
              w.progress);
  EXPECT_TRUE(w.any("ignored: KHR_materials_sheen"));

  EXPECT_NE(error_text(R"({"asset":{"version":"1.0"}})").find("version 1.0"), std::string::npos);
  EXPECT_NE(error_text("{\"asset\":").find("JSON"), std::string::npos);
  const TemporaryFolder folder;
  EXPECT_THROW(import_gltf(folder.write("x.glb", "glTF")), Error);
  EXPECT_THROW(import_gltf(folder.write("x.obj", "v 0 0 0\n")), NotMyFormat);
  EXPECT_THROW(import_gltf(folder.path() / "none.glb"), Error);
  EXPECT_NE(error_of([&] { import_scene(folder.write("x.xyz", "?")); }).find("OBJ"), std::string::npos);
  std::string deep(100000, '[');
  EXPECT_NE(error_text(R"({"asset":{"version":"2.0"},"extras":)" + deep).find("nested"), std::string::npos);
}

}  // namespace
}  // namespace sconce
