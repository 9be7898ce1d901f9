// SPDX-License-Identifier: Apache-2.0
// Measured lamps by side file and by glTF: where they shine and how strong.
#include "core/kelvin.h"
#include "import/lights.h"
#include "import/test_files.h"
#include "import/uri.h"
#include "photometry/light_field_file.h"

namespace sconce {
namespace {

/// 1000 cd around nadir, 200 at the horizon of C0, 100 at that of C90; 2000 lm lamp; 0.2 m along C0, 1 m
/// along C90.
const char* kLamp =
    "IESNA:LM-63-2002\n[TEST] x\nTILT=INCLUDE\n1\n3\n0 90 180\n1 0.5 0.5\n1 2000 1 2 2 1 2 1 0.2 0\n1 1 "
    "30\n0 90\n0 90\n"
    "1000 200\n1000 100\n";

struct Room {
  TemporaryFolder folder;
  Warnings warnings;

  Scene with(const std::string& nodes, const std::string& side = "", const std::string& more = "") {
    GltfBuilder b;
    b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    folder.write("lamp.ies", kLamp);
    const auto path = folder.write(
        "room.gltf",
        b.json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":0}]}],
          "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1]}}],"nodes":[{"mesh":0})" +
               nodes + "]" + more));
    folder.write("room.toml", side);
    return import_scene(path, warnings.progress);
  }
  std::string error(const std::string& nodes, const std::string& side = "", const std::string& more = "") {
    return error_of([&] { with(nodes, side, more); });
  }
};

/// cd towards a direction of the world, green.
double candela(const Scene& scene, std::size_t light, const Vec3& direction) {
  const Light& l = scene.lights.at(light);
  return static_cast<double>(l.intensity.g) *
         intensity(scene[std::get<LuminaireLight>(l.shape).luminaire].photometry,
                   glm::normalize(direction) * Mat3(l.frame));
}

TEST(Luminaires, HangAsTheSideFileSays) {
  Room room;
  const Scene scene = room.with("", R"(
[[luminaire]]
file = "lamp.ies"
at = [1, 2, 3]

[[luminaire]]
file = "lamp.ies"
at = [0, 2, 0]
roll = 90
name = "turned"
group = "desk"

[[luminaire]]
file = "lamp.ies"
at = [0, 2, 0]
aim = [0, 2, 5]

[[luminaire]]
file = "lamp.ies"
at = [0, 2, 0]
direction = [0, 1, 0]
)");
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(Vec3(scene.lights[0].frame[3]), Vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_NEAR(candela(scene, 0, {0, -1, 0}), 1000, 1e-3) << "straight down";
  EXPECT_NEAR(candela(scene, 0, {1, -1e-5f, 0}), 200, 0.1) << "C0 towards +x";
  EXPECT_NEAR(candela(scene, 0, {0, -1e-5f, -1}), 100, 0.1) << "C90 towards -z";
  EXPECT_NEAR(candela(scene, 0, {0, 1, 0}), 0, 0);
  EXPECT_EQ(scene.lights[1].name, "turned");
  EXPECT_EQ(scene.lights[1].group_name, "desk");
  EXPECT_NEAR(candela(scene, 1, {0, -1e-5f, -1}), 200, 0.1) << "roll takes C0 to where C90 was";
  // Tilted by 90 degrees this lamp gives half its light (TILT).
  EXPECT_NEAR(candela(scene, 2, {0, 0, 1}), 500, 1e-3);
  EXPECT_NEAR(candela(scene, 2, {1, 0, 1e-5f}), 100, 0.1) << "the shortest turn leaves C0 towards +x";
  EXPECT_NEAR(candela(scene, 3, {0, 1, 0}), 500, 1e-3);
  EXPECT_NEAR(candela(scene, 3, {1, 1e-5f, 0}), 100, 0.1);
}

TEST(Luminaires, StrengthAndColour) {
  Room room;
  const Scene scene = room.with("", R"(
[[luminaire]]
file = "lamp.ies"
at = [0, 2, 0]
flux = 750
cct = 3000
dim = 0.5
)");
  const Light& light = scene.lights.at(0);
  const double table = flux(scene.luminaires.at(0).photometry);
  EXPECT_NEAR(luminance(light.intensity) * table, 375, 1e-2);
  EXPECT_NEAR(light.intensity.r / luminance(light.intensity), kelvin_color(3000).r, 1e-4);
}

TEST(Luminaires, GridsShareTheirData) {
  Room room;
  const Scene scene = room.with("", R"(
[[luminaire]]
file = "lamp.ies"
at = [10, 3, 0]
count = [3, 2]
pitch = [2, 2.4]
name = "office"
)");
  ASSERT_EQ(scene.lights.size(), 6u);
  EXPECT_EQ(scene.luminaires.size(), 1u);
  EXPECT_NEAR(glm::distance(Vec3(scene.lights[0].frame[3]), Vec3(8, 3, -1.2f)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(Vec3(scene.lights[5].frame[3]), Vec3(12, 3, 1.2f)), 0, 1e-6);
  EXPECT_EQ(scene.lights[5].name, "office.006");
}

TEST(Luminaires, OfGltfNodes) {
  Room room;
  const Scene scene = room.with(
      R"(,{"name":"ies:lamp.ies.001","translation":[0,2,0],"scale":[3,3,3]},
         {"name":"desk","extras":{"luminaire":{"file":"lamp.ies","dim":0.5},"light_group":"work"}},
         {"name":"spot","extensions":{"KHR_lights_punctual":{"light":0}},"extras":{"luminaire":"lamp.ies"}},
         {"name":"web","rotation":[-0.7071068,0,0,0.7071068],
          "extensions":{"EXT_lights_ies":{"light":0,"multiplier":2,"color":[1,0.5,0.25]}}})",
      "",
      R"(,"extensionsUsed":["EXT_lights_ies"],"extensions":{"EXT_lights_ies":{"lights":[{"uri":"lamp.ies"}]},
         "KHR_lights_punctual":{"lights":[{"type":"spot","intensity":5,"spot":{}}]}})");
  EXPECT_TRUE(room.warnings.lines.empty()) << room.warnings.lines.at(0);
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.luminaires.size(), 1u) << "one file, however it is named";
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_NEAR(candela(scene, 0, {0, -1, 0}), 1000, 1e-2) << "a node hangs";
  EXPECT_NEAR(candela(scene, 0, {1, -1e-5f, 0}), 200, 0.1);
  EXPECT_NEAR(candela(scene, 1, {0, -1, 0}), 500, 1e-2);
  EXPECT_EQ(scene.lights[1].group_name, "work");
  EXPECT_NEAR(candela(scene, 2, {0, 0, -1}), 500, 1e-2)
      << "in place of a spot, along its -z; tilted by 90 degrees";
  EXPECT_NEAR(candela(scene, 3, {0, -1, 0}), 1000, 0.1)
      << "the extension's -z, turned down; 2 x 0.5 in green";
  EXPECT_FLOAT_EQ(scene.lights[3].intensity.r, 2);
  const auto files = scene_files(room.folder.path() / "room.gltf");
  EXPECT_TRUE(
      std::any_of(files.begin(), files.end(), [](const auto& f) { return f.filename() == "lamp.ies"; }));
}

/// 2 lm straight down through one pixel of M.
LightField beam() {
  LightField field = make_light_field(NearBasis::bell, Vec2(0), Vec2(0), 0.01, 0.2, 0.1, 5);
  field.irradiance[4 * field.pixels() + 12] = static_cast<float>(2 / (field.pixel * field.pixel));
  return field;
}

TEST(Luminaires, LightFieldsAreLampsToo) {
  Room room;
  write_light_field(room.folder / "lamp.exr", beam());
  const Scene scene = room.with(R"(,{"name":"ies:lamp.exr","translation":[0,2,0]},
      {"extras":{"luminaire":{"file":"lamp.exr","exact_below":0.25}}})",
                                R"(
[[luminaire]]
file = "lamp.exr"
at = [0, 2, 0]
flux = 50
exact_below = 0.02
)");
  ASSERT_EQ(scene.lights.size(), 3u);
  for (const Light& light : scene.lights) {
    const Luminaire& luminaire = scene[std::get<LuminaireLight>(light.shape).luminaire];
    ASSERT_TRUE(luminaire.field);
    EXPECT_EQ(luminaire.field->irradiance, beam().irradiance);
    EXPECT_NEAR(flux(luminaire.photometry), 2, 1e-6) << "the table has the images' flux";
  }
  EXPECT_FLOAT_EQ(std::get<LuminaireLight>(scene.lights[0].shape).exact_below, 0.1f);
  EXPECT_FLOAT_EQ(std::get<LuminaireLight>(scene.lights[1].shape).exact_below, 0.25f);
  EXPECT_FLOAT_EQ(std::get<LuminaireLight>(scene.lights[2].shape).exact_below, 0.02f);
  EXPECT_NEAR(scene.lights[2].intensity.g, 25, 1e-4);
  EXPECT_NE(room.error("", "[[luminaire]]\nfile = \"lamp.ies\"\nat = [0,0,0]\nexact_below = 0.1\n")
                .find("lamp.ies is no light field"),
            std::string::npos);
  room.folder.write("lamp.exr", "no picture");
  EXPECT_NE(room.error("", "[[luminaire]]\nfile = \"lamp.exr\"\nat = [0,0,0]\n").find("room.toml:2"),
            std::string::npos);
}

// A command line's words are a side file's, in its own or in [[light]]'s terms.
TEST(Luminaires, WordsAreTables) {
  Room room;
  const Scene scene = room.with("", R"(
[[luminaire]]
file = "lamp.ies"
at = [0, 2, 0]
aim = [1, 0, 0]
roll = 30
flux = 500
cct = 3000
)");
  const std::string file = (room.folder / "lamp.ies").string();
  for (const std::string words : {"position=0,2,0,target=1,0,0,roll=30,lumens=500,kelvin=3000",
                                  "at=0,2,0,aim=1,0,0,roll=30,flux=500,cct=3000"}) {
    const MoreLights more = parse_lights("luminaire,file=" + file + "," + words, "test");
    ASSERT_EQ(more.lights.size(), 1u);
    EXPECT_EQ(more.lights[0].frame, scene.lights.at(0).frame);
    EXPECT_EQ(more.lights[0].intensity, scene.lights.at(0).intensity);
    EXPECT_EQ(more.luminaires.at(0).photometry.candela, scene.luminaires.at(0).photometry.candela);
  }
  const auto told = error_of([&] { parse_lights("luminaire,file=" + file + ",at=0,2,0,count=2,2", "test"); });
  EXPECT_TRUE(told.starts_with("test: unknown key 'count'")) << told;

  const auto lights = room.folder.write("lights.toml",
                                        "[[luminaire]]\nfile = \"lamp.ies\"\nat = [0,2,0]\n\n"
                                        "[[light]]\ntype = \"sun\"\nintensity = 3\n\n"
                                        "[[luminaire]]\nfile = \"lamp.ies\"\nat = [1,2,0]\nflux = 700\n");
  const MoreLights all = read_lights(lights);
  ASSERT_EQ(all.lights.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<SunLight>(all.lights[0].shape));
  EXPECT_EQ(std::get<LuminaireLight>(all.lights[2].shape).luminaire.value, 1u);
}

TEST(Luminaires, BadInput) {
  Room room;
  const auto side = [&](const std::string& keys) {
    const std::string all = room.error("", "[[luminaire]]\n" + keys + "\n");
    return all.substr(std::min(all.size(), all.find("room.toml")));
  };
  EXPECT_EQ(side("at = [0,0,0]"),
            "room.toml:1: [[luminaire]]: has no file (allowed: file = an .ies, .ldt or light field (.exr) "
            "beside this one)");
  EXPECT_NE(side("file = \"none.ies\"\nat = [0,0,0]").find("room.toml:2: [[luminaire]] file: "),
            std::string::npos);
  EXPECT_NE(side("file = \"lamp.ies\"\nat = [0,0,0]\ncount = [2, 2]").find("stands without pitch"),
            std::string::npos);
  EXPECT_NE(side("file = \"lamp.ies\"\nat = [0,0,0]\ncount = [2.5, 2]\npitch = [1,1]").find("whole numbers"),
            std::string::npos);
  EXPECT_NE(side("file = \"lamp.ies\"\nat = [0,0,0]\naim = [0,0,0]").find("has no length"),
            std::string::npos);
  EXPECT_NE(side("file = \"lamp.ies\"\nat = [0,0,0]\nlumens = 3").find("flux"), std::string::npos)
      << "lists the keys";
  EXPECT_NE(room.error(R"(,{"name":"ies:none.ldt"})").find("'none.ldt', which is not there"),
            std::string::npos);
  EXPECT_NE(room.error(R"(,{"extensions":{"EXT_lights_ies":{"light":1}}})", "",
                       R"(,"extensions":{"EXT_lights_ies":{"lights":[{"uri":"lamp.ies"}]}})")
                .find("profile 1"),
            std::string::npos);
}

}  // namespace
}  // namespace sconce
