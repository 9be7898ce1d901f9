// SPDX-License-Identifier: Apache-2.0
#include "package/glb.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "image/io.h"
#include "package/test_package.h"
#include "photometry/light_field.h"

namespace sconce {
namespace {

Image8 pattern(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i)
    image.data.push_back(static_cast<unsigned char>(i * 37));
  return image;
}

Scene sample() {
  Scene scene = test_package(2, 1, 4, 4).scene;
  Texture encoded, raw, absent;
  encoded.name = "encoded";
  encoded.pixels = pattern(3, 2, 3);
  encoded.file = encode_png(encoded.pixels);
  encoded.mime = "image/png";
  encoded.wrap_u = Texture::Wrap::mirror;
  encoded.wrap_v = Texture::Wrap::clamp;
  encoded.nearest = true;
  raw.name = "raw";
  raw.pixels = pattern(2, 2, 4);
  absent.name = "absent";
  scene.textures = {encoded, raw, absent};

  Material lamp;
  lamp.name = "lamp";
  lamp.base_color = {0.1f, 0.2f, 0.3f};
  lamp.alpha = 0.75f;
  lamp.metallic = 0.3f;
  lamp.roughness = 0.7f;
  lamp.emission = {1234.5f, 0.1f, 77.7f};
  lamp.emission_texture.texture = Id<Texture>(2);
  lamp.base_color_texture = {Id<Texture>(0), 1, {0.1f, 0.2f}, {3, 4}, 0.5f};
  lamp.metallic_roughness_texture.texture = Id<Texture>(1);
  lamp.normal_texture = {Id<Texture>(1), 1, {0.5f, 0}, {2, 2}, 0};
  lamp.normal_scale = 0.75f;
  lamp.alpha_mode = Material::Alpha::mask;
  lamp.alpha_cutoff = 0.3f;
  lamp.double_sided = true;
  scene.materials.push_back(lamp);
  scene.materials.push_back(lamp);
  scene.materials[2].alpha_mode = Material::Alpha::blend;
  scene.materials[2].emission = {0.5f, 0.25f, 0.1f};

  scene.meshes.push_back(test_quad("front", Id<Material>(1), 1));
  scene.meshes.push_back(test_quad("back", Id<Material>(1), 1, true));
  scene.meshes[0].normals.clear();
  scene.meshes[1].tangents.assign(4, {0, 0.6f, 0.8f, -1});
  Instance instance;
  instance.name = "front";
  instance.mesh = Id<Mesh>(1);
  instance.group = Id<LightGroup>(1);
  instance.transform[3] = {0.1f, 0.2f, 0.3f, 1};
  instance.lightmap_scale = 0.5f;
  scene.instances.push_back(instance);
  instance.name = "back";
  instance.mesh = Id<Mesh>(2);
  scene.instances.push_back(instance);

  Light light;
  light.frame[3] = {1, 2, 3, 1};
  light.intensity = {0.3f, 1000.1f, 5};
  light.group_name = "asked";
  light.name = "point";
  light.shape = PointLight{4};
  scene.lights.push_back(light);
  light.name = "spot";
  light.shape = SpotLight{0.2f, 0.4f, 0};
  scene.lights.push_back(light);
  light.name = "sun";
  light.shape = SunLight{};
  light.group = Id<LightGroup>(0);
  scene.lights.push_back(light);
  light.name = "sky";
  light.shape = SkyLight{};
  scene.lights.push_back(light);
  Photometry table;
  table.azimuths = {0, 360};
  table.polars = {0, 50, 90};
  table.candela = {1.0 / 3, 77.7, 0, 1.0 / 3, 77.7, 0};
  table.opening = {Opening::Shape::cylinder, 2, Vec3(0.1f, 0.1f, 0)};
  scene.luminaires.push_back({"lamp.ldt", table});
  light.name = "measured";
  light.shape = LuminaireLight{Id<Luminaire>(0)};
  scene.lights.push_back(light);
  LightField field = make_light_field(NearBasis::spline, Vec2(-0.1f), Vec2(0.1f, 0.05f), 0.03, 0.5, 0.4, 3);
  for (std::size_t i = 0; i < field.irradiance.size(); ++i)
    field.irradiance[i] = 0.1f * static_cast<float>(i) - 3;
  scene.luminaires.push_back({"lamp.exr", table, std::make_shared<LightField>(field)});
  light.name = "near";
  light.shape = LuminaireLight{Id<Luminaire>(1), 0.03f};
  scene.lights.push_back(light);
  for (int i = 0; i < 3; ++i)
    for (const float v : field.irradiance) field.color.push_back(v * static_cast<float>(i + 1));
  set_luminance(field);
  scene.luminaires.push_back({"colored.exr", table, std::make_shared<LightField>(field)});
  Image slide = Image::rgb(3, 2);
  for (std::size_t i = 0; i < slide.data.size(); ++i) slide.data[i] = 0.3f * static_cast<float>(i);
  light.name = "slide";
  light.shape = ProjectorLight{std::make_shared<Image>(slide), 0.7f, 1.25f};
  scene.lights.push_back(light);
  light.name = "colored";
  light.shape = LuminaireLight{Id<Luminaire>(2)};
  scene.lights.push_back(light);
  return scene;
}

TEST(Glb, SceneComesBack) {
  const Scene a = sample(), b = read_glb(write_glb(a, "test"), "scene.glb");
  EXPECT_EQ(b.name, a.name);
  ASSERT_EQ(b.textures.size(), 3u);
  EXPECT_EQ(b.textures[0].file, a.textures[0].file);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(b.textures[i].name, a.textures[i].name);
    EXPECT_EQ(b.textures[i].pixels.data, a.textures[i].pixels.data);
    EXPECT_EQ(b.textures[i].wrap_u, a.textures[i].wrap_u);
    EXPECT_EQ(b.textures[i].wrap_v, a.textures[i].wrap_v);
    EXPECT_EQ(b.textures[i].nearest, a.textures[i].nearest);
  }
  ASSERT_EQ(b.materials.size(), a.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const Material &x = a.materials[i], &y = b.materials[i];
    EXPECT_EQ(y.name, x.name);
    EXPECT_EQ(y.base_color, x.base_color);
    EXPECT_EQ(y.alpha, x.alpha);
    EXPECT_EQ(y.metallic, x.metallic);
    EXPECT_EQ(y.roughness, x.roughness);
    EXPECT_EQ(y.emission, x.emission);
    EXPECT_EQ(y.normal_scale, x.normal_scale);
    EXPECT_EQ(y.alpha_mode, x.alpha_mode);
    if (x.alpha_mode == Material::Alpha::mask) {
      EXPECT_EQ(y.alpha_cutoff, x.alpha_cutoff);
    }
    EXPECT_EQ(y.double_sided, x.double_sided);
    for (const auto use : {&Material::base_color_texture, &Material::metallic_roughness_texture,
                           &Material::emission_texture, &Material::normal_texture}) {
      EXPECT_EQ((y.*use).texture, (x.*use).texture);
      EXPECT_EQ((y.*use).texcoord, (x.*use).texcoord);
      EXPECT_EQ((y.*use).offset, (x.*use).offset);
      EXPECT_EQ((y.*use).scale, (x.*use).scale);
      EXPECT_EQ((y.*use).rotation, (x.*use).rotation);
    }
  }
  ASSERT_EQ(b.meshes.size(), a.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(b.meshes[i].material, a.meshes[i].material);
    EXPECT_EQ(b.meshes[i].positions, a.meshes[i].positions);
    EXPECT_EQ(b.meshes[i].normals, a.meshes[i].normals);
    EXPECT_EQ(b.meshes[i].tangents, a.meshes[i].tangents);
    EXPECT_EQ(b.meshes[i].texcoords, a.meshes[i].texcoords);
    ASSERT_EQ(b.meshes[i].triangles.size(), a.meshes[i].triangles.size());
    for (std::size_t t = 0; t < a.meshes[i].triangles.size(); ++t)
      EXPECT_EQ(b.meshes[i].triangles[t].v, a.meshes[i].triangles[t].v);
  }
  ASSERT_EQ(b.instances.size(), 3u);
  EXPECT_EQ(b.instances[1].transform, a.instances[1].transform);
  EXPECT_EQ(b.instances[1].group_name, "b");
  EXPECT_EQ(b.instances[1].lightmap_scale, 0.5f);
  EXPECT_EQ(b.instances[2].mesh, a.instances[2].mesh);
  ASSERT_EQ(b.lights.size(), 8u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(b.lights[i].name, a.lights[i].name);
    EXPECT_EQ(b.lights[i].frame, a.lights[i].frame);
    EXPECT_EQ(b.lights[i].intensity, a.lights[i].intensity);
    EXPECT_EQ(b.lights[i].shape.index(), a.lights[i].shape.index());
  }
  EXPECT_EQ(std::get<PointLight>(b.lights[0].shape).range, 4);
  EXPECT_EQ(std::get<SpotLight>(b.lights[1].shape).inner, 0.2f);
  EXPECT_EQ(std::get<SpotLight>(b.lights[1].shape).outer, 0.4f);
  EXPECT_EQ(b.lights[0].group_name, "asked");
  EXPECT_EQ(b.lights[2].group_name, "a");
  EXPECT_TRUE(std::holds_alternative<SkyLight>(b.lights.back().shape));
  EXPECT_EQ(b.lights.back().group_name, "a");
  const auto lamp =
      std::find_if(b.lights.begin(), b.lights.end(), [](const Light& l) { return l.name == "measured"; });
  ASSERT_NE(lamp, b.lights.end());
  EXPECT_EQ(lamp->intensity, a.lights[4].intensity);
  EXPECT_EQ(lamp->frame, a.lights[4].frame);
  EXPECT_EQ(lamp->group_name, "a");
  ASSERT_EQ(std::get<LuminaireLight>(lamp->shape).luminaire, Id<Luminaire>(0));
  EXPECT_EQ(b.luminaires[0].name, "lamp.ldt");
  EXPECT_EQ(b.luminaires[0].photometry.candela, a.luminaires[0].photometry.candela);
  EXPECT_EQ(b.luminaires[0].photometry.opening.size, a.luminaires[0].photometry.opening.size);
  EXPECT_EQ(b.luminaires[0].photometry.opening.shape, Opening::Shape::cylinder);
  const auto thrown =
      std::find_if(b.lights.begin(), b.lights.end(), [](const Light& l) { return l.name == "slide"; });
  ASSERT_NE(thrown, b.lights.end());
  const auto &slide = std::get<ProjectorLight>(thrown->shape),
             &given = std::get<ProjectorLight>(a.lights[6].shape);
  EXPECT_EQ(slide.slide->data, given.slide->data);
  EXPECT_EQ(slide.slide->width, 3);
  EXPECT_EQ(slide.yfov, 0.7f);
  EXPECT_EQ(slide.aspect, 1.25f);
  const auto near =
      std::find_if(b.lights.begin(), b.lights.end(), [](const Light& l) { return l.name == "near"; });
  ASSERT_NE(near, b.lights.end());
  const auto& placed = std::get<LuminaireLight>(near->shape);
  EXPECT_EQ(placed.exact_below, 0.03f);
  EXPECT_FALSE(b.luminaires[0].field);
  ASSERT_TRUE(b.luminaires.at(placed.luminaire.value).field);
  const LightField &before = *a.luminaires[1].field, &after = *b.luminaires[1].field;
  EXPECT_EQ(after.irradiance, before.irradiance);
  EXPECT_EQ(after.basis, before.basis);
  EXPECT_EQ(after.first, before.first);
  EXPECT_EQ(after.corner, before.corner);
  EXPECT_EQ(after.columns, before.columns);
  EXPECT_EQ(after.height, before.height);
  EXPECT_EQ(after.spacing, before.spacing);
  EXPECT_EQ(after.distance, before.distance);
  EXPECT_EQ(after.pixel, before.pixel);
  EXPECT_TRUE(after.is_grey());
  ASSERT_EQ(b.luminaires.size(), 3u);
  ASSERT_TRUE(b.luminaires[2].field);
  EXPECT_EQ(b.luminaires[2].field->color, a.luminaires[2].field->color);
  EXPECT_EQ(b.luminaires[2].field->irradiance, a.luminaires[2].field->irradiance);
  ASSERT_EQ(b.cameras.size(), 1u);
  EXPECT_EQ(b.cameras[0].name, "main");
  EXPECT_EQ(b.cameras[0].frame, a.cameras[0].frame);
  EXPECT_EQ(b.cameras[0].yfov, a.cameras[0].yfov);
}

TEST(Glb, MeshWithoutTrianglesIsNamed) {
  Scene scene = sample();
  scene.meshes[1].triangles.clear();
  EXPECT_THROW(write_glb(scene, "test"), Error);
}

TEST(Glb, WhatIsNotFiniteIsNotWritten) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Scene scene = sample();
  scene.meshes[1].positions[0].z = kNaN;
  EXPECT_THROW(write_glb(scene, "test"), Error);
  scene = sample();
  scene.meshes[0].texcoords.back()[1].y = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_glb(scene, "test"), Error);
  scene = sample();
  scene.materials[0].roughness = kNaN;  // JSON
  try {
    write_glb(scene, "test");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("materials/0/pbrMetallicRoughness/roughnessFactor"),
              std::string::npos)
        << e.what();
  }
}

// Damage anywhere gives an Error or another scene, never a crash.
TEST(Glb, DamageNeverCrashes) {
  const std::string bytes = write_glb(sample(), "test");
  for (std::size_t n = 0; n < bytes.size(); n += 13)
    EXPECT_THROW(read_glb(bytes.substr(0, n), "g"), Error) << n;
  std::minstd_rand random(1);
  int errors = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = bytes;
    for (unsigned k = 0; k <= random() % 3; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    try {
      read_glb(damaged, "g");
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).rfind("g", 0), 0u) << e.what();
      ++errors;
    }
  }
  EXPECT_GT(errors, 100);
}

}  // namespace
}  // namespace sconce
