// SPDX-License-Identifier: Apache-2.0
// Materials, textures, lamps and Draco of glTF, on files made by the test.
#include <draco/compression/encode.h>

#include "core/test_data.h"
#include "image/io.h"
#include "import/test_files.h"

namespace sconce {
namespace {

/// One triangle with a material, lamps and whatever else the root may hold.
Scene import_with(const std::string& rest, const TemporaryFolder& folder, const Progress& progress = {}) {
  const GltfBuilder b = triangle();
  return import_gltf(
      folder.write(
          "scene.gltf",
          b.json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)" + rest)),
      progress);
}

std::string pixels(std::vector<unsigned char> data, int width, int height, int channels) {
  const auto png = encode_png({width, height, channels, std::move(data)});
  return {png.begin(), png.end()};
}

TEST(GltfMaterials, AllThatALightmapNeeds) {
  const TemporaryFolder folder;
  folder.write("base.png", pixels({255, 0, 0, 0, 255, 0}, 2, 1, 3));
  folder.write("glow.png", pixels({255, 255, 255}, 1, 1, 3));
  Warnings w;
  const Scene scene = import_with(R"("nodes":[{"mesh":0}],"materials":[
    {"name":"full","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.6,
      "baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":{"offset":[0.25,0.5],"scale":[2,3],
      "rotation":1.5,"texCoord":3}}}},"emissiveFactor":[1,0.5,0.25],"emissiveTexture":{"index":1},
      "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":200}},"alphaMode":"MASK","alphaCutoff":0.3,"doubleSided":true},
    {"name":"plain"},{"name":"glass","alphaMode":"BLEND"},
    {"name":"unlit","extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"roughnessFactor":0.1,"baseColorTexture":{"index":2}}}],
    "textures":[{"source":0,"sampler":0},{"source":1},{"source":0}],"images":[{"uri":"base.png"},{"uri":"glow.png"}],
    "samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}])",
                                  folder, w.progress);
  ASSERT_EQ(scene.materials.size(), 4u);
  const Material& full = scene.materials[0];
  EXPECT_EQ(full.base_color, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_FLOAT_EQ(full.alpha, 0.4f);
  EXPECT_FLOAT_EQ(full.metallic, 0.5f);
  EXPECT_FLOAT_EQ(full.roughness, 0.6f);
  EXPECT_EQ(full.emission, Rgb(200, 100, 50));
  EXPECT_TRUE(full.emission_texture.texture.valid());
  EXPECT_EQ(full.alpha_mode, Material::Alpha::mask);
  EXPECT_FLOAT_EQ(full.alpha_cutoff, 0.3f);
  EXPECT_TRUE(full.double_sided);
  EXPECT_EQ(full.base_color_texture.texcoord, 3u);
  EXPECT_EQ(full.base_color_texture.offset, Vec2(0.25f, 0.5f));
  EXPECT_EQ(full.base_color_texture.scale, Vec2(2, 3));
  EXPECT_FLOAT_EQ(full.base_color_texture.rotation, 1.5f);

  const Texture& texture = scene[full.base_color_texture.texture];
  EXPECT_EQ(texture.pixels.width, 2);
  EXPECT_EQ(texture.pixels.data[0], 255);
  EXPECT_EQ(texture.mime, "image/png");
  EXPECT_EQ(texture.file.size(), std::filesystem::file_size(folder.path() / "base.png"));
  EXPECT_EQ(texture.wrap_u, Texture::Wrap::clamp);
  EXPECT_EQ(texture.wrap_v, Texture::Wrap::mirror);
  EXPECT_TRUE(texture.nearest);
  const Texture& repeated = scene[scene.materials[3].base_color_texture.texture];
  EXPECT_EQ(repeated.wrap_u, Texture::Wrap::repeat);
  EXPECT_FALSE(repeated.nearest);

  EXPECT_FLOAT_EQ(scene.materials[1].metallic, 1);  // glTF's default
  EXPECT_EQ(scene.materials[2].alpha_mode, Material::Alpha::blend);
  EXPECT_TRUE(scene.passes(scene.materials[2]) == (scene.materials[2].alpha < 1));
  EXPECT_FLOAT_EQ(scene.materials[3].metallic, 0);
  EXPECT_FALSE(scene.materials[3].mirrors());
}

TEST(GltfMaterials, NormalMapsAndTangents) {
  const TemporaryFolder folder;
  folder.write("bumps.png", pixels({128, 128, 255}, 1, 1, 3));
  GltfBuilder b = triangle();
  b.accessor(b.view<float>({1, 0, 0, -1, 0, 1, 0, 1, 0, 0, 1, 1}), 5126, "VEC4", 3);
  const Scene scene = import_gltf(folder.write(
      "scene.gltf",
      b.json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TANGENT":1},"material":0}]}],
    "nodes":[{"mesh":0}],"materials":[{"normalTexture":{"index":0,"texCoord":1,"scale":0.5,"extensions":{
    "KHR_texture_transform":{"scale":[4,2]}}}},{}],"textures":[{"source":0}],"images":[{"uri":"bumps.png"}])")));
  const Material& bumpy = scene.materials.at(0);
  EXPECT_TRUE(scene.has_normal_maps());
  EXPECT_EQ(scene[bumpy.normal_texture.texture].pixels.data[2], 255);
  EXPECT_EQ(bumpy.normal_texture.texcoord, 1u);
  EXPECT_EQ(bumpy.normal_texture.scale, Vec2(4, 2));
  EXPECT_EQ(bumpy.normal_scale, 0.5f);
  EXPECT_FALSE(scene.materials.at(1).normal_texture.texture.valid());
  EXPECT_EQ(scene.meshes.at(0).tangents, (std::vector<glm::vec4>{{1, 0, 0, -1}, {0, 1, 0, 1}, {0, 0, 1, 1}}));
}

TEST(GltfMaterials, MissingAndDamagedTexturesAreNamed) {
  const TemporaryFolder folder;
  folder.write("bad.png", "\x89PNG no");
  Warnings w;
  const Scene scene = import_with(
      R"("nodes":[{"mesh":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
    {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},{"pbrMetallicRoughness":{"baseColorTexture":{"index":2}}}],
    "textures":[{"source":0},{"source":1},{}],"images":[{"uri":"rug%20red.png"},{"uri":"bad.png"}])",
      folder, w.progress);
  for (int i = 0; i < 3; ++i) {
    const Material& m = scene.materials[static_cast<std::size_t>(i)];
    EXPECT_FALSE(m.base_color_texture.texture.valid());
    EXPECT_EQ(m.base_color, Rgb(0.5f));
  }
  EXPECT_TRUE(w.any("texture rug red.png is left out"));
  EXPECT_TRUE(w.any("texture bad.png is left out"));
  EXPECT_TRUE(w.any("textures[2] has no picture"));
  EXPECT_NE(error_of([&] {
              import_with(R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":5}}}])",
                          folder);
            }).find("baseColorTexture: index 5"),
            std::string::npos);
}

TEST(GltfMaterials, InlineGreyAndAlphaPictures) {
  const TemporaryFolder folder;
  const std::string grey = pixels({10, 200}, 2, 1, 1);
  const std::string uri =
      "data:image/png;base64," + encode_base64(std::vector<unsigned char>(grey.begin(), grey.end()));
  const Scene scene = import_with(
      R"("nodes":[{"mesh":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
    "textures":[{"source":0}],"images":[{"uri":")" +
          uri + "\"}]",
      folder);
  const Image8& image = scene.textures.at(0).pixels;
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(image.data, (std::vector<unsigned char>{10, 10, 10, 200, 200, 200}));
}

TEST(GltfLights, NumbersAsTheyStand) {
  const TemporaryFolder folder;
  const Scene scene = import_with(R"("materials":[{}],"nodes":[{"mesh":0},
    {"name":"Lamp","scale":[3,3,3],"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
    {"rotation":[-0.7071068,0,0,0.7071068],"extensions":{"KHR_lights_punctual":{"light":1}},"extras":{"light_group":"down"}},
    {"name":"group:day","extensions":{"KHR_lights_punctual":{"light":2}}}],
    "extensions":{"KHR_lights_punctual":{"lights":[
      {"type":"point","color":[1,0.5,0.25],"intensity":40,"range":7},
      {"name":"beam","type":"spot","intensity":100,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}},
      {"type":"directional","intensity":1000,"extras":{"light_group":"sunny"}}]}})",
                                  folder);
  ASSERT_EQ(scene.lights.size(), 3u);
  const Light& point = scene.lights[0];
  EXPECT_EQ(point.name, "Lamp");
  EXPECT_EQ(point.intensity, Rgb(40, 20, 10));
  EXPECT_FLOAT_EQ(std::get<PointLight>(point.shape).range, 7);
  EXPECT_EQ(Vec3(point.frame[3]), Vec3(1, 2, 3));
  EXPECT_NEAR(glm::length(Vec3(point.frame[2])), 1, 1e-6);  // scale does not touch lamps
  const Light& spot = scene.lights[1];
  EXPECT_EQ(spot.name, "beam");
  EXPECT_EQ(spot.group_name, "down");
  EXPECT_FLOAT_EQ(std::get<SpotLight>(spot.shape).inner, 0.2f);
  EXPECT_FLOAT_EQ(std::get<SpotLight>(spot.shape).outer, 0.5f);
  EXPECT_NEAR(-spot.frame[2].y, -1, 1e-5);  // a quarter turn back about x points -z down
  EXPECT_EQ(scene.lights[2].intensity, Rgb(1000));
  EXPECT_EQ(scene.lights[2].group_name, "day");
  EXPECT_TRUE(std::holds_alternative<SunLight>(scene.lights[2].shape));

  const auto error = [&](const std::string& lights, const char* index = "0") {
    return error_of([&] {
      import_with(R"("materials":[{}],"nodes":[{"extensions":{"KHR_lights_punctual":{"light":)" +
                      std::string(index) + R"(}}}],"extensions":{"KHR_lights_punctual":{"lights":[)" +
                      lights + "]}}",
                  folder);
    });
  };
  EXPECT_NE(error(R"({"type":"area"})").find("'area' is unknown"), std::string::npos);
  EXPECT_NE(error(R"({"type":"point"})", "3").find("index 3"), std::string::npos);
  EXPECT_NE(error(R"({"type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5}})").find("cone"),
            std::string::npos);
}

struct LightFile {
  const char* path;
  std::size_t suns, points, spots;
};
class SharedLights : public testing::TestWithParam<LightFile> {};

TEST_P(SharedLights, Count) {
  const auto path = test_data() / "lights" / GetParam().path;
  SCONCE_NEEDS_DATA(path);
  std::size_t suns = 0, points = 0, spots = 0;
  for (const Light& l : import_gltf(path).lights) {
    suns += std::holds_alternative<SunLight>(l.shape);
    points += std::holds_alternative<PointLight>(l.shape);
    spots += std::holds_alternative<SpotLight>(l.shape);
  }
  EXPECT_EQ(suns, GetParam().suns);
  EXPECT_EQ(points, GetParam().points);
  EXPECT_EQ(spots, GetParam().spots);
}

// The buffers of the second to fourth are absent (Git LFS pointers); lamps need none.
INSTANTIATE_TEST_SUITE_P(Files, SharedLights,
                         testing::Values(LightFile{"gltf-playcanvas/Lights.glb", 1, 1, 2},
                                         LightFile{"gltf-atteneder/Directional/LightsDirectional.gltf", 1, 0,
                                                   0},
                                         LightFile{"gltf-atteneder/Point/LightsPoint.gltf", 0, 3, 0},
                                         LightFile{"gltf-atteneder/Spot/LightsSpot.gltf", 0, 0, 3}));

TEST(GltfLights, SixteenStrengthsOfEmission) {
  const auto path = test_data() / "lights/gltf-blender-io/14_emission_strength/14_emission_strength.gltf";
  SCONCE_NEEDS_DATA(path);
  int emissive = 0;
  for (const Material& m : import_gltf(path).materials) emissive += m.emits();
  EXPECT_EQ(emissive, 16);
}

/// A square compressed by Draco, as a glTF whose accessors have no views of their own.
std::string draco_square(int position_id, int index_count) {
  draco::Mesh mesh;
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  mesh.set_num_points(4);
  const int id = mesh.AddAttribute(attribute, true, 4);
  for (unsigned i = 0; i < 4; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), corners[i]);
  mesh.AddFace({{draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)}});
  mesh.AddFace({{draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)}});
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  GltfBuilder b;
  b.view(std::vector<unsigned char>(buffer.data(), buffer.data() + buffer.size()));
  b.accessor(-1, 5126, "VEC3", 4);
  b.accessor(-1, 5123, "SCALAR", static_cast<std::size_t>(index_count));
  return b.json(
      R"("extensionsRequired":["KHR_draco_mesh_compression"],"nodes":[{"mesh":0}],"meshes":[{"primitives":[
      {"attributes":{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,
      "attributes":{"POSITION":)" +
      std::to_string(position_id) + "}}}}]}]");
}

TEST(GltfDraco, SquareAndDamage) {
  const TemporaryFolder folder;
  const Scene scene = import_gltf(folder.write("square.gltf", draco_square(0, 6)));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(flat_area(mesh), 1, 1e-3);  // Draco quantises

  EXPECT_NE(
      error_of([&] { import_gltf(folder.write("id.gltf", draco_square(9, 6))); }).find("no attribute 9"),
      std::string::npos);
  std::string cut = draco_square(0, 6);
  cut.replace(cut.find("\"byteOffset\":0"), 14, "\"byteOffset\":9");
  EXPECT_NE(error_of([&] { import_gltf(folder.write("cut.gltf", cut)); }).find("beyond its buffer"),
            std::string::npos);
}

}  // namespace
}  // namespace sconce
