// SPDX-License-Identifier: Apache-2.0
// Extensions that other tools put into glTF files: meshopt streams, instancing, WebP and KTX2 pictures.
#include <meshoptimizer.h>
#include <webp/encode.h>

#include "import/test_files.h"

namespace sconce {
namespace {

using Stream = std::vector<unsigned char>;

std::string meshopt_view(int buffer, std::size_t bytes, int stride, std::size_t count, const char* mode) {
  return R"({"buffer":)" + std::to_string(buffer + 1) + R"(,"byteLength":)" +
         std::to_string(count * static_cast<std::size_t>(stride)) +
         R"(,"extensions":{"EXT_meshopt_compression":{"buffer":)" + std::to_string(buffer) +
         R"(,"byteOffset":0,"byteLength":)" + std::to_string(bytes) + R"(,"byteStride":)" +
         std::to_string(stride) + R"(,"count":)" + std::to_string(count) + R"(,"mode":")" + mode + "\"}}}";
}

std::string data_uri(const Stream& stream) {
  return R"({"byteLength":)" + std::to_string(stream.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + encode_base64(stream) + "\"}";
}

/// A square of two triangles, its positions and indices compressed.
std::string meshopt_square(const char* mode = "TRIANGLES") {
  const float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const unsigned indices[6] = {0, 1, 2, 0, 2, 3};
  Stream vertices(meshopt_encodeVertexBufferBound(4, 12)), triangles(meshopt_encodeIndexBufferBound(6, 4));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions, 4, 12));
  triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices, 6));
  const std::string fallback =
      R"({"byteLength":48,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";
  return R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],"buffers":[)" +
         data_uri(vertices) + "," + fallback + "," + data_uri(triangles) + "," + fallback +
         R"(],"bufferViews":[)" + meshopt_view(0, vertices.size(), 12, 4, "ATTRIBUTES") + "," +
         meshopt_view(2, triangles.size(), 2, 6, mode) +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},
         {"bufferView":1,"componentType":5123,"type":"SCALAR","count":6}],"nodes":[{"mesh":0}],
         "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})";
}

TEST(GltfMeshopt, SquareAndDamage) {
  const TemporaryFolder folder;
  Warnings w;
  const Scene scene = import_gltf(folder.write("square.gltf", meshopt_square()), w.progress);
  EXPECT_FALSE(w.any("buffer"));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_FLOAT_EQ(flat_area(mesh), 1);

  const auto refused = [&](std::string text, const char* part, const char* instead) {
    text.replace(text.find(part), std::strlen(part), instead);
    return error_of([&] { import_gltf(folder.write("bad.gltf", text)); });
  };
  EXPECT_NE(refused(meshopt_square(), "\"byteOffset\":0", "\"byteOffset\":9").find("beyond its buffer"),
            std::string::npos);
  EXPECT_NE(
      refused(meshopt_square(), "\"count\":6,\"mode\"", "\"count\":9999999,\"mode\"").find("bytes can hold"),
      std::string::npos);
  EXPECT_NE(refused(meshopt_square(), "\"TRIANGLES\"", "\"STRIPS\"").find("mode 'STRIPS'"),
            std::string::npos);
  EXPECT_NE(refused(meshopt_square(), "\"TRIANGLES\"", "\"ATTRIBUTES\"").find("byteStride 2"),
            std::string::npos);
  EXPECT_NE(refused(meshopt_square(), "base64,o", "base64,A").find("damaged"), std::string::npos);
}

TEST(GltfInstancing, CopiesStandWhereTheyAreTold) {
  GltfBuilder b = triangle();
  b.accessor(b.view(std::vector<float>{1, 0, 0, 0, 2, 0}), 5126, "VEC3", 2);
  b.accessor(b.view(std::vector<float>{0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f}), 5126, "VEC4", 2);
  b.accessor(b.view(std::vector<float>{1, 1, 1, 2, 2, 2}), 5126, "VEC3", 2);
  const TemporaryFolder folder;
  const std::string rest =
      std::string(kTriangleMesh) +
      R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"translation":[0,0,5],"extensions":
      {"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"ROTATION":2,"SCALE":3}}}}])";
  const Scene scene = import_gltf(folder.write("x.gltf", b.json(rest)));
  ASSERT_EQ(scene.instances.size(), 2u);
  const auto corner = [&](std::size_t i) {
    return Vec3(scene.instances[i].transform * glm::vec4(1, 0, 0, 1));
  };
  EXPECT_LT(glm::length(corner(0) - Vec3(2, 0, 5)), 1e-5f);
  EXPECT_LT(glm::length(corner(1) - Vec3(0, 4, 5)), 1e-5f);  // twice as large, a quarter turn about z
  EXPECT_THROW(import_gltf(folder.write("bad.gltf", b.json([&] {
                 std::string bad = rest;
                 return bad.replace(bad.find("\"SCALE\":3"), 9, "\"SCALE\":9");
               }()))),
               Error);
}

std::string textured(const Stream& picture, const char* extension) {
  GltfBuilder b = triangle();
  return b.json(std::string(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "nodes":[{"mesh":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
    "textures":[{"extensions":{")") +
                extension + R"(":{"source":0}}}],"extensionsRequired":[")" + extension +
                R"("],"images":[{"uri":"data:image/x;base64,)" + encode_base64(picture) + "\"}]");
}

TEST(GltfPictures, WebpIsDecoded) {
  const Stream pixels = {255, 0, 0, 0, 128, 0, 0, 0, 255, 10, 20, 30};
  unsigned char* encoded = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(pixels.data(), 2, 2, 6, &encoded);
  const Stream file(encoded, encoded + size);
  WebPFree(encoded);
  const TemporaryFolder folder;
  const Scene scene = import_gltf(folder.write("x.gltf", textured(file, "EXT_texture_webp")));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].pixels.data, pixels);
  Warnings w;
  import_gltf(folder.write("cut.gltf", textured({file.begin(), file.begin() + 20}, "EXT_texture_webp")),
              w.progress);
  EXPECT_TRUE(w.any("damaged WebP"));
}

TEST(GltfPictures, Ktx2NamesAConverter) {
  Stream file = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
  file.resize(80);
  const TemporaryFolder folder;
  Warnings w;
  const Scene scene = import_gltf(folder.write("x.gltf", textured(file, "KHR_texture_basisu")), w.progress);
  EXPECT_TRUE(w.any("ktx extract"));
  EXPECT_EQ(scene.instances.size(), 1u);
}

}  // namespace
}  // namespace sconce
