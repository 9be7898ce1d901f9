// SPDX-License-Identifier: Apache-2.0
#include "core/kelvin.h"
#include "core/test_toml.h"
#include "image/io.h"
#include "import/test_files.h"
#include "scene/daylight.h"
#include "scene/groups.h"

namespace sconce {
namespace {

/// Two squares of 1 m and 2 m edge with a material each, a lamp and a camera.
const char* kRoom = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":0}]},
  {"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":1}]}],
  "nodes":[{"name":"globe.001","mesh":0},{"name":"globe.002","mesh":0,"scale":[2,2,2],"translation":[5,0,0]},{"name":"wall","mesh":1},
  {"name":"Spot","translation":[0,3,0],"extensions":{"KHR_lights_punctual":{"light":0}}},{"name":"main","camera":0}],
  "materials":[{"name":"glass","emissiveFactor":[1,1,1]},{"name":"plaster"}],
  "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":2,"znear":0.1}}],
  "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":100,"color":[1,0.5,0.5],
  "spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}}]}})";

struct Room {
  TemporaryFolder folder;
  Warnings warnings;

  Scene with(const std::string& side) {
    GltfBuilder b;
    b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const auto path = folder.write("room.gltf", b.json(kRoom));
    folder.write("room.toml", side);
    return import_scene(path, warnings.progress);
  }
  std::string error(const std::string& side) {
    return error_of([&] { with(side); });
  }
};

TEST(SideFile, AddsLights) {
  Room room;
  const Scene scene = room.with(R"(
[[light]]
name = "pendant"
type = "point"
position = [1, 2, 3]
lumens = 800
kelvin = 2700
range = 4
group = "table"

[[light]]
name = "beam"
type = "spot"
position = [0, 2, 0]
target = [0, 0, 0]
lumens = 100
inner = 10
outer = 30

[[light]]
type = "sun"
direction = [0, -1, -1]
intensity = 50000
color = "#ff8000"

[options]
quality = "final"
)");
  ASSERT_EQ(scene.lights.size(), 4u);
  const Light& pendant = scene.lights[1];
  EXPECT_EQ(pendant.group_name, "table");
  EXPECT_NEAR(luminance(pendant.intensity), 800 / (4 * kPi), 1e-2);
  EXPECT_NEAR(pendant.intensity.r / luminance(pendant.intensity), kelvin_color(2700).r, 1e-4);
  EXPECT_EQ(std::get<PointLight>(pendant.shape).range, 4);
  const Light& beam = scene.lights[2];
  const double inner = std::cos(10 * M_PI / 180), outer = std::cos(30 * M_PI / 180);
  EXPECT_NEAR(beam.intensity.g, 100 / (2 * M_PI * ((1 - inner) + (inner - outer) / 3)), 1e-2);
  EXPECT_NEAR(-beam.frame[2].y, -1, 1e-6);
  const Light& sun = scene.lights[3];
  EXPECT_NEAR(luminance(sun.intensity), 50000, 1);  // whatever the colour
  EXPECT_GT(sun.intensity.r, sun.intensity.g);
  EXPECT_NEAR(-sun.frame[2].z, -std::sqrt(0.5), 1e-6);
}

// Flux: pi x I for a panel, E x the picture's area at 1 m for a projector in white.
TEST(SideFile, PanelsAndProjectors) {
  Room room;
  Image slide = Image::rgb(4, 2);
  slide.set_rgb(1, 0, {2, 3, 4});
  write_exr(room.folder.path() / "slide.exr", slide, PixelType::full);
  const Scene scene = room.with(R"(
[[light]]
name = "panel"
type = "area"
size = [1.2, 0.3]
position = [0, 2, 0]
lumens = 1000
[[light]]
type = "area"
radius = 0.25
position = [0, 2, 0]
target = [1, 2, 0]
intensity = 10
[[light]]
name = "slide"
type = "projector"
file = "slide.exr"
position = [0, 1, 3]
direction = [0, 0, -1]
fov = 40
roll = 90
lumens = 500
[[light]]
name = "Spot"
type = "projector"
file = "slide.exr"
aspect = 1
)");
  ASSERT_EQ(scene.lights.size(), 4u);
  const auto& panel = std::get<LuminaireLight>(scene.lights[1].shape);
  const Photometry& table = scene[panel.luminaire].photometry;
  EXPECT_NEAR(luminance(scene.lights[1].intensity), 1000 / M_PI, 0.02);
  EXPECT_NEAR(flux(table), M_PI, 1e-4);
  EXPECT_NEAR(intensity_at(table, 77, 60.5), std::cos(60.5 * M_PI / 180), 1e-4);
  EXPECT_EQ(table.opening.size, Vec3(1.2f, 0.3f, 0));
  const auto& disk = std::get<LuminaireLight>(scene.lights[2].shape);
  EXPECT_EQ(scene[disk.luminaire].photometry.opening.shape, Opening::Shape::cylinder);
  EXPECT_EQ(scene[disk.luminaire].photometry.opening.size, Vec3(0.5f, 0.5f, 0));
  EXPECT_EQ(scene.lights[2].intensity, Rgb(10));
  const auto& projector = std::get<ProjectorLight>(scene.lights[3].shape);
  EXPECT_EQ(projector.slide->rgb_at(1, 0), Rgb(2, 3, 4));
  EXPECT_EQ(projector.aspect, 2);
  const double half = std::tan(20 * M_PI / 180);
  EXPECT_NEAR(scene.lights[3].intensity.g, 500 / (4 * half * half * 2), 1e-2);
  // Rolled to the left, as seen along the beam: its right is up.
  EXPECT_NEAR(scene.lights[3].frame[0].y, 1, 1e-6);
  EXPECT_EQ(std::get<ProjectorLight>(scene.lights[0].shape).aspect, 1);
  EXPECT_EQ(scene.lights[0].intensity, Rgb(100, 50, 50));
  const auto files = scene_files(room.folder.path() / "room.gltf");
  EXPECT_NE(std::find(files.begin(), files.end(), room.folder.path() / "slide.exr"), files.end());
  const std::string begin = "[[light]]\nposition = [0, 2, 0]\nintensity = 1\n";
  EXPECT_NE(room.error(begin + "type = \"area\"\n").find("size = [width, height] or radius"),
            std::string::npos);
  EXPECT_NE(room.error(begin + "type = \"area\"\nsize = [1, 0]\n").find("not positive"), std::string::npos);
  EXPECT_NE(room.error(begin + "type = \"projector\"\n").find("has no slide"), std::string::npos);
  EXPECT_NE(room.error(begin + "type = \"projector\"\nfile = \"none.png\"\n").find("none.png"),
            std::string::npos);
  EXPECT_NE(room.error(begin + "type = \"spot\"\nfov = 3\n").find("fov: is for projectors only"),
            std::string::npos);
  slide.set_rgb(0, 0, Rgb(-1));
  write_exr(room.folder.path() / "dark.exr", slide, PixelType::full);
  EXPECT_NE(room.error(begin + "type = \"projector\"\nfile = \"dark.exr\"\n").find("negative"),
            std::string::npos);
}

TEST(SideFile, OverridesOnlyWhatItNames) {
  Room room;
  const Scene scene = room.with("[[light]]\nname = \"Spot\"\nintensity = 10\ngroup = \"x\"\n");
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& spot = scene.lights[0];
  EXPECT_NEAR(luminance(spot.intensity), 10, 1e-5);
  EXPECT_NEAR(spot.intensity.g / spot.intensity.r, 0.5, 1e-5);  // its colour stays
  EXPECT_FLOAT_EQ(std::get<SpotLight>(spot.shape).outer, 0.5f);
  EXPECT_EQ(spot.frame[3].y, 3);
  EXPECT_EQ(spot.group_name, "x");
  const Scene white = room.with("[[light]]\nname = \"Spot\"\nkelvin = 6504\n");
  EXPECT_NEAR(white.lights[0].intensity.r, luminance(Rgb(100, 50, 50)), 1e-3);  // its strength stays
}

TEST(SideFile, GroupsByGlobs) {
  Room room;
  Scene scene = room.with("[group.bulbs]\nnodes = [\"globe*\"]\n[group.\"the spots\"]\nlights = \"Sp?t\"\n");
  assign_groups(scene, Grouping::named);
  ASSERT_EQ(scene.groups.size(), 2u);
  EXPECT_EQ(scene.groups[0].name, "bulbs");
  EXPECT_EQ(scene.groups[1].name, "the spots");
  scene = room.with("[group.glow]\nmaterials = [\"gl*\"]\n[group.none]\nnodes = [\"glob\"]\n");
  EXPECT_EQ(scene.instances[1].group_name, "glow");
  EXPECT_EQ(scene.instances[2].group_name, "");
  EXPECT_TRUE(room.warnings.any("'glob' matches nothing"));
}

TEST(SideFile, EmissionOfMaterialsAndNodes) {
  Room room;
  const Scene level = room.with("[[emission]]\nmaterial = \"glass\"\nluminance = 500\ncolor = [2, 1, 0]\n");
  EXPECT_NEAR(luminance(level.materials[0].emission), 500, 1e-2);
  EXPECT_NEAR(level.materials[0].emission.r / level.materials[0].emission.g, 2, 1e-5);

  // 1 m2 and 4 m2 of it: 5 m2.
  const Scene flux = room.with("[[emission]]\nmaterial = \"glass\"\nlumens = 1000\n");
  EXPECT_NEAR(flux.materials[0].emission.r, 1000 / (kPi * 5), 1e-2);

  // One node of the two that share the material.
  const Scene one = room.with(
      "[[emission]]\nnode = \"globe.002\"\nlumens = 1000\ngroup = "
      "\"big\"\n[[material]]\nmatch=\"plaster\"\ndouble_sided=true\n");
  EXPECT_EQ(one.materials[0].emission, Rgb(1));
  EXPECT_NEAR(one[one[one.instances[1].mesh].material].emission.r, 1000 / (kPi * 4), 1e-2);
  EXPECT_EQ(one.instances[1].group_name, "big");
  EXPECT_EQ(one.instances[0].group_name, "");
  EXPECT_TRUE(one.materials[1].double_sided);

  const Scene wall = room.with(
      "[[material]]\nmatch=\"plaster\"\ndouble_sided=true\nbase_color=\"#ffffff\"\n[[emission]]\nnode = "
      "\"wall\"\nlumens = 100\nkelvin = 6504\n");
  EXPECT_NEAR(wall[wall[wall.instances[2].mesh].material].emission.g, 100 / (2 * kPi), 1e-3);  // both sides
  EXPECT_EQ(wall.materials[1].base_color, Rgb(1));

  const Scene tiled = room.with("[[material]]\nmatch=\"plaster\"\nroughness=0.2\nmetallic=0\n");
  EXPECT_EQ(tiled.materials[1].roughness, 0.2f);
  EXPECT_TRUE(tiled.materials[1].mirrors());
}

TEST(SideFile, CamerasAndSky) {
  Room room;
  Image image = Image::rgb(4, 2);
  image.set_rgb(1, 0, {2, 3, 4});
  write_exr(room.folder.path() / "env.exr", image, PixelType::full);
  const Scene scene = room.with(R"(
[[camera]]
name = "main"
hfov = 90
[[camera]]
name = "door"
eye = [0, 1.6, 3]
target = [0, 1.6, 0]
fov = 60
aspect = 1.5
[sky]
file = "env.exr"
intensity = 10
rotate = 90
)");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_NEAR(scene.cameras[0].yfov, 2 * std::atan(0.5f), 1e-5);
  EXPECT_NEAR(scene.cameras[1].yfov, kPi / 3, 1e-5);
  EXPECT_NEAR(-scene.cameras[1].frame[2].z, -1, 1e-6);
  const Light& sky = scene.lights.back();
  EXPECT_EQ(sky.group_name, "sky");
  EXPECT_EQ(sky.intensity, Rgb(10));
  EXPECT_EQ(std::get<SkyLight>(sky.shape).image.rgb_at(1, 0), Rgb(2, 3, 4));
  // The picture's centre, -z of its frame, turned counter-clockwise seen from above: now at -x.
  EXPECT_NEAR(-sky.frame[2].x, -1, 1e-6);
  EXPECT_EQ(scene_files(room.folder.path() / "room.gltf").size(), 2u);

  const Scene plain = room.with("[sky]\nluminance = 3000\nkelvin = 6504\n");
  EXPECT_NEAR(plain.lights.back().intensity.b, 3000, 1);
  EXPECT_NE(room.error("[sky]\nfile = \"gone.exr\"\n").find("gone.exr"), std::string::npos);
}

TEST(SideFile, SkiesByFormulaAndTheSun) {
  Room room;
  const Scene day = room.with(
      "[sun]\nlatitude = 48\nlongitude = 11\ntime = \"2026-06-21T13:00+02:00\"\n"
      "[sky]\nkind = \"cie-clear\"\nilluminance = 12000\n");
  const Light &sky = day.lights.back(), &sun = day.lights[day.lights.size() - 2];
  EXPECT_EQ(sun.group_name, "sun");
  EXPECT_GT(sun.frame[2].y, 0.85);  // high above the south
  EXPECT_GT(sun.frame[2].z, 0.2);
  EXPECT_GT(luminance(sun.intensity), 90000);
  EXPECT_NEAR(horizontal_illuminance(std::get<SkyLight>(sky.shape).image), 12000, 2);
  EXPECT_FALSE(room.warnings.any("no lights"));

  room.with("[sun]\nelevation = -3\n");
  EXPECT_TRUE(room.warnings.any("below the horizon"));
  EXPECT_NE(room.error("[sky]\nkind = \"cie-clear\"\n").find("[sun]"), std::string::npos);
  EXPECT_NE(room.error("[sky]\nkind = \"grey\"\n").find("cie-overcast, cie-clear, preetham, file"),
            std::string::npos);
  EXPECT_NE(room.error("[sky]\nkind = \"cie-overcast\"\nluminance = 3\n").find("stands beside kind"),
            std::string::npos);
  EXPECT_NE(room.error("[sky]\nluminance = 3\nturbidity = 3\n").find("by formula"), std::string::npos);
  EXPECT_NE(room.error("[sun]\nlatitude = 3\n").find("go together"), std::string::npos);
  EXPECT_NE(room.error("[sun]\nlatitude = 3\nlongitude = 3\ntime = \"noon\"\n").find("'noon' is no time"),
            std::string::npos);
}

TEST(SideFile, WhatHasNoLightGetsASky) {
  const TemporaryFolder folder;
  Warnings w;
  const Scene scene = import_scene(folder.write("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), w.progress);
  EXPECT_TRUE(w.any("overcast sky of 10,000 lx"));
  EXPECT_TRUE(w.any("[[light]]"));
  EXPECT_TRUE(w.any("x.toml"));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(horizontal_illuminance(std::get<SkyLight>(scene.lights[0].shape).image), 10000, 1);
}

TEST(SideFile, ErrorsNameLineKeyAndChoices) {
  Room room;
  const std::string unknown = room.error("\n[[light]]\nname = \"a\"\nintensty = 3\n");
  EXPECT_NE(unknown.find("room.toml:4: unknown key 'intensty' in [[light]]; did you mean 'intensity'? "
                         "(allowed: name, type,"),
            std::string::npos)
      << unknown;
  EXPECT_NE(room.error("[lights]\n").find("unknown key 'lights'"), std::string::npos);
  EXPECT_NE(room.error("[[light]]\nname = = 3\n").find("room.toml:2"), std::string::npos);
  for (const std::string& text : broken_toml()) {
    const std::string line = room.error(text);
    EXPECT_NE(line.find("room.toml:"), std::string::npos) << text.substr(0, 40) << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  EXPECT_NE(room.error("[[light]]\ntype = \"lamp\"\n").find("point, spot, sun"), std::string::npos);
  EXPECT_NE(room.error("[[light]]\ntype = \"point\"\nintensity = 1\n").find("has no position"),
            std::string::npos);
  EXPECT_NE(room.error("[[light]]\ntype = \"point\"\nposition = [0, 1]\nintensity = 1\n").find("[x, y, z]"),
            std::string::npos);
  EXPECT_NE(room.error("[[light]]\ntype = \"sun\"\nlumens = 1\n").find("lux"), std::string::npos);
  EXPECT_NE(room.error("[[light]]\nname = \"Spot\"\nkelvin = 100\n").find("1000 to 11000"),
            std::string::npos);
  EXPECT_NE(room.error("[[light]]\nname = \"Spot\"\ncolor = \"red\"\n").find("#rrggbb"), std::string::npos);
  EXPECT_NE(room.error("[[light]]\nname = \"Spot\"\nouter = 100\n").find("90"), std::string::npos);
  EXPECT_NE(room.error("[group.all]\nnodes = []\n").find("reserved"), std::string::npos);
  EXPECT_NE(room.error("[[camera]]\nname = \"new\"\n").find("eye"), std::string::npos);
  EXPECT_NE(room.error("[sky]\nrotate = 3\n").find("luminance"), std::string::npos);
  EXPECT_NE(room.error("[[emission]]\nlumens = 3\n").find("material"), std::string::npos);
  EXPECT_NE(room.error("light = 3\n").find("no table"), std::string::npos);
}

}  // namespace
}  // namespace sconce
