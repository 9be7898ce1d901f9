// SPDX-License-Identifier: Apache-2.0
// The adapter for Cycles (solvers/cycles), with Blender: an independent renderer, given what an external
// solver gets, must find the layers that our path tracer finds.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "blender.h"
#include "core/test_data.h"
#include "core/text.h"
#include "image/io.h"
#include "lightmap_error.h"
#include "package/glb.h"
#include "process.h"
#include "scene/shapes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using test::LightmapError;

class Cycles : public test::BlenderTest {
 protected:
  TemporaryFolder folder;

  /// @return the package, or nothing after a failure
  Package bake(const std::string& scene, const std::string& name, const std::string& solver, int samples,
               std::vector<std::string> more = {}) const {
    const std::string output = (folder / name).string();
    more.insert(more.begin(), {"bake", scene, "--solver", solver, "--samples", std::to_string(samples),
                               "--encoding", "f32", "--quiet", "-o", output});
    const test::Outcome outcome = test::run_sconce(more);
    if (outcome.code != 0) throw Error(output, outcome.err);
    return Package::open(output);
  }
  /// Cycles against two bakes by `solver`.
  std::vector<LightmapError> compare(const std::string& scene, int cycles, const std::string& solver,
                                     int samples, const std::vector<std::string>& options) const {
    const auto with = [&](const char* seed) {
      std::vector<std::string> more = options;
      more.insert(more.end(), {"--seed", seed});
      return more;
    };
    const std::string adapter = "external:" SCONCE_SOURCE_DIR "/solvers/cycles/sconce-cycles";
    return test::lightmap_errors(bake(scene, "cycles", adapter, cycles, with("1")),
                                 bake(scene, "s0", solver, samples, with("2")),
                                 bake(scene, "s1", solver, samples, with("3")));
  }
};

// Closed box, emission L = 2 and reflectance 0.5 everywhere: E = pi L / (1 - 0.5). It fixes the factor
// between what Cycles bakes and illuminance.
TEST_F(Cycles, Furnace) {
  Scene scene;
  add_box(scene, "walls", add_material(scene, "glow", Rgb(0.5f), Rgb(2)), Vec3(-1), Vec3(1), true);
  const std::string file = folder.write("box.glb", write_glb(scene, "test"));
  const Package package = bake(file, "cycles", "external:" SCONCE_SOURCE_DIR "/solvers/cycles/sconce-cycles",
                               64, {"--atlas", "32"});
  const Image layer = package.layer(0, 0), receivers = package.receivers(0);
  const std::vector<uint8_t> inside = test::interior_texels(receivers);
  const float expected = kPi * 2 / (1 - 0.5f);
  int seen = 0;
  double mean = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] == 0) continue;
    EXPECT_NEAR(layer.data[3 * i + 1], expected, 0.2f * expected) << "noise of 64 paths";
    mean += static_cast<double>(layer.data[3 * i + 1]);
    ++seen;
  }
  ASSERT_GT(seen, 50);
  EXPECT_NEAR(mean / seen, static_cast<double>(expected), 0.01 * static_cast<double>(expected));
}

Id<Texture> add_texture(Scene& scene, std::vector<unsigned char> rgba) {
  Texture texture;
  texture.pixels = {2, 2, 4, std::move(rgba)};
  texture.nearest = true;
  scene.textures.push_back(std::move(texture));
  return Id<Texture>(scene.textures.size() - 1);
}

Light lamp(const std::string& name, const Rgb& intensity, decltype(Light::shape) shape, const Mat4& frame) {
  Light light;
  light.name = light.group_name = name;
  light.intensity = intensity;
  light.shape = std::move(shape);
  light.frame = frame;
  return light;
}

/// -z of it points at `to`.
Mat4 aimed(const Vec3& from, const Vec3& to) {
  return glm::inverse(glm::lookAt(from, to, Vec3(0.1f, 0.9f, 0.3f)));
}

// Every kind of lamp, textures with their transforms, cut-outs, both sides of a sheet, all in the open.
Scene yard() {
  Scene scene;
  const auto tiles = add_material(scene, "tiles", Rgb(0.9f, 0.8f, 0.7f));
  const auto cutout = add_material(scene, "cutout", Rgb(0.7f, 0.4f, 0.2f), {}, true);
  TextureUse& colour = scene.materials[tiles.value].base_color_texture;
  colour.texture =
      add_texture(scene, {255, 40, 40, 255, 60, 255, 60, 255, 60, 60, 255, 255, 240, 240, 240, 255});
  colour.scale = Vec2(1.5f, 0.75f);
  colour.rotation = 0.4f;
  colour.offset = Vec2(0.2f, 0.1f);
  Material& mask = scene.materials[cutout.value];
  mask.alpha_mode = Material::Alpha::mask;
  mask.base_color_texture.texture =
      add_texture(scene, {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 255});
  add_quad(scene, "floor", tiles, Vec3(-2, 0, -2), Vec3(0, 0, 4), Vec3(4, 0, 0));
  add_quad(scene, "wall", add_material(scene, "red", Rgb(0.6f, 0.1f, 0.1f)), Vec3(-2, 0, -2), Vec3(4, 0, 0),
           Vec3(0, 2, 0));
  add_quad(scene, "sheet", cutout, Vec3(0.5f, 0.05f, -1), Vec3(0.3f, 0, 2), Vec3(0, 1.5f, 0));
  for (Mesh& mesh : scene.meshes) mesh.texcoords = {{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};

  scene.lights = {lamp("bulb", Rgb(8, 6, 4), PointLight{}, aimed(Vec3(-1, 1.2f, 0.7f), Vec3(0))),
                  lamp("ranged", Rgb(5), PointLight{3}, aimed(Vec3(1.2f, 1, 0.3f), Vec3(0))),
                  lamp("spot", Rgb(20, 22, 25), SpotLight{0.35f, 0.9f, 0},
                       aimed(Vec3(-0.5f, 2, 1.5f), Vec3(0.3f, 0, -1))),
                  lamp("sunny", Rgb(3, 2.5f, 2), SunLight{}, aimed(Vec3(-2, 3, 2), Vec3(0)))};
  return scene;
}

TEST_F(Cycles, LampsSkiesTexturesAndTwins) {
  const std::string scene = folder.write("yard.glb", write_glb(yard(), "test"));
  Image sky(16, 8, {"R", "G", "B"});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      float* pixel = sky.at(x, y);
      pixel[0] = x < 4 ? 4 : 0.2f;
      pixel[1] = y < 2 ? 2 : 0.5f;
      pixel[2] = x >= 8 && x < 11 ? 3 : 0.5f;
    }
  write_exr(folder / "sky.exr", sky, PixelType::full);
  folder.write("yard.toml", "[sky]\nfile = \"sky.exr\"\nrotate = 20\nintensity = 2\n");
  const auto errors = compare(scene, 256, "path", 512, {"--atlas", "64", "--bounces", "4"});
  ASSERT_EQ(errors.size(), 5u);
  for (const LightmapError& error : errors) {
    EXPECT_NEAR(error.mean_ratio, 1, 0.01) << error.group;
    EXPECT_LT(error.rmse, 0.05) << error.group;
    EXPECT_GT(error.texels, 1000u);
  }
}

TEST_F(Cycles, CornellBox) {
  const fs::path scene = test_data() / "glb" / "cornell-box.glb";
  SCONCE_NEEDS_DATA(scene);
  for (const auto& [solver, samples] : {std::pair("path", 1024), {"radiosity", 256}})
    for (const LightmapError& error : compare(scene.string(), 512, solver, samples, {"--atlas", "64"})) {
      EXPECT_NEAR(error.mean_ratio, 1, 0.01) << solver;
      EXPECT_LT(error.rmse, 0.05) << solver << ": noise of the two, and texels at the lamp's edge";
    }
}

}  // namespace
}  // namespace sconce
