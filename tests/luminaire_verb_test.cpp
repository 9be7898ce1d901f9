// SPDX-License-Identifier: Apache-2.0
// `sconce luminaire` on several files, on rays in watts, on modelled lamps, and with a scene before the wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "core/test_data.h"
#include "core/test_folder.h"
#include "image/io.h"
#include "photometry/formats.h"
#include "photometry/light_field_file.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

using test::run_sconce;

constexpr double kPiD = 3.14159265358979323846;

// A plate halfway throws a shadow of twice its size; beside it nothing changes. C0 is +x, C90 is up in the
// picture and -z in the scene.
TEST(LuminaireLamps, RenderBehindAScene) {
  const TemporaryFolder folder;
  const std::string ies =
      folder
          .write("point.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 180\n0\n100 100\n")
          .string();
  const std::string plate =
      folder.write("plate.obj", "v 0 -0.5 0\nv 0.2 -0.5 0\nv 0.2 -0.5 -0.1\nv 0 -0.5 -0.1\nf 1 2 3 4\n")
          .string();
  const auto picture = [&](std::vector<std::string> more) {
    const std::string out = (folder / "wall.exr").string();
    std::vector<std::string> words = {"luminaire", "render", ies, "--width", "1", "--size", "20", "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_sconce(words).code, 0);
    return read_exr(out);
  };
  const Image open = picture({}), shaded = picture({"--scene", plate, "--shadow-rays", "4"});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const bool dark = x >= 10 && x < 18 && y < 10 && y >= 6;  // 0 to 0.4 m, 0 to 0.2 m
      const double want = dark ? 0 : static_cast<double>(open.rgb_at(x, y).g);
      EXPECT_NEAR(static_cast<double>(shaded.rgb_at(x, y).g), want, 1e-4 * (1 + want)) << x << " " << y;
    }
}

TEST(LuminaireLamps, BrokenOnesAndWatts) {
  const auto data = test_data() / "photometry";
  SCONCE_NEEDS_DATA(data);
  // A broken file among others is told; the others are checked.
  const auto among =
      run_sconce({"luminaire", "check", (data / "ies/ies_rescale/Truncated Profile - 01.IES").string(),
                  (data / "ldt/eulumdat-py/sample4.ldt").string()});
  EXPECT_EQ(among.code, 1);
  EXPECT_NE(among.err.find("Truncated Profile - 01.IES:25: ends before"), std::string::npos) << among.err;
  EXPECT_NE(among.out.find("sample4.ldt: 5543.9 lm, rendered 5543.9 lm"), std::string::npos) << among.out;
  // Folders: all lamps in them, and what there was in all.
  const auto folder =
      run_sconce({"luminaire", "check", (data / "tm25").string(), (data / "ies/ies_rescale").string()});
  EXPECT_EQ(folder.code, 1);
  EXPECT_NE(folder.out.find("farfield.TM25ray: 31350.1 W, rendered 31349.5 W\n"), std::string::npos)
      << folder.out;
  EXPECT_EQ(folder.out.find("no luminous opening"), std::string::npos) << "rays start somewhere";
  EXPECT_NE(folder.out.find("\n13 files: 7 in order, 5 with warnings, 1 not read\n"), std::string::npos)
      << folder.out;
  const TemporaryFolder none;
  EXPECT_EQ(run_sconce({"luminaire", "check", (none / "").string()}).code, 1);
  const auto watts =
      run_sconce({"luminaire", "field", (data / "tm25/CreatePointSourceRayFile/farfield.TM25ray").string(),
                  "-o", "x.exr"});
  EXPECT_EQ(watts.code, 2);
  EXPECT_NE(watts.err.find("--lumens: is needed"), std::string::npos) << watts.err;
}

// A modelled luminaire to rays and these to what the luminaire itself gives: the same rays, but for their
// millimetres. Emitters of two colours whose light a coloured wall sends back; other rays agree within noise.
TEST(LuminaireLamps, SceneToRays) {
  const TemporaryFolder folder;
  Scene scene;
  const auto emitter = [&](const char* name, const Rgb& light, float x) {
    add_quad(scene, name, add_material(scene, name, Rgb(0), light), Vec3(x, 0, -0.01f), Vec3(0.01f, 0, 0),
             Vec3(0, 0, 0.02f));
  };
  emitter("warm", Rgb(4000, 3000, 1000), 0), emitter("cold", Rgb(1000, 2000, 3000), 0.02f);
  const Id<Material> wall = add_material(scene, "wall", Rgb(0.5f, 0.6f, 0.4f));
  scene.materials[wall.value].double_sided = true;
  add_quad(scene, "wall", wall, Vec3(-0.01f, 0, -0.05f), Vec3(0, -0.1f, 0), Vec3(0, 0, 0.1f));
  folder.write("lamp.glb", write_glb(scene, "test"));
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "luminaire"), words.push_back("--json");
    const auto out = run_sconce(words);
    EXPECT_EQ(out.code, 0) << out.err;
    return nlohmann::json::parse(out.out);
  };
  const auto convert = [&](const char* from, const char* to, const char* seed) {
    return run({"convert", path(from), "-o", path(to), "--rays", "200000", "--seed", seed})
        .at("lumens")
        .get<double>();
  };
  const double sent = convert("lamp.glb", "lamp.tm25ray", "1");
  EXPECT_NEAR(run({"info", path("lamp.tm25ray")}).at("lumens").get<double>() / sent, 1, 1e-9);
  EXPECT_NEAR(convert("lamp.glb", "same.tm25ray", "1") / sent, 1, 1e-15);
  std::string bytes[2];
  for (const int i : {0, 1}) bytes[i] = read_file(path(i == 0 ? "lamp.tm25ray" : "same.tm25ray"));
  EXPECT_TRUE(bytes[0] == bytes[1]);
  // 2 mm2 of (4000, 3000, 1000) and (1000, 2000, 3000) cd/m2: their luminance; some of it is lost in the
  // wall.
  const double emitted = kPiD * 2e-4 * (0.2126 * 5000 + 0.7152 * 5000 + 0.0722 * 4000);
  EXPECT_LT(sent, emitted);
  EXPECT_GT(sent, 0.7 * emitted);

  const auto field = [&](const char* from, const char* to) {
    const auto out =
        run({"field", path(from), "-o", path(to), "--rays", "200000", "--pixels", "8", "--spacing", "10"});
    EXPECT_NEAR((out.at("lumens").get<double>() + out.at("lumens_lost").get<double>()) / sent, 1, 1e-9)
        << from;
    return read_light_field(path(to));
  };
  const LightField of_scene = field("lamp.glb", "scene.exr"), of_rays = field("lamp.tm25ray", "rays.exr");
  ASSERT_EQ(of_rays.irradiance.size(), of_scene.irradiance.size());
  ASSERT_FALSE(of_rays.is_grey());
  const float most = *std::max_element(of_scene.color.begin(), of_scene.color.end());
  for (std::size_t i = 0; i < of_scene.color.size(); ++i)
    ASSERT_NEAR(of_rays.color[i], of_scene.color[i], 2e-3f * most)
        << i;  // rays at pixels' edges change sides

  convert("lamp.glb", "scene.ies", "1"), convert("lamp.tm25ray", "rays.ies", "1");
  convert("lamp.glb", "other.ies", "2");
  const Photometry a = read_photometry(path("scene.ies")), b = read_photometry(path("rays.ies")),
                   other = read_photometry(path("other.ies"));
  EXPECT_NEAR(flux(b) / sent, 1, 1e-9);
  for (const double gamma : {0.0, 30.0, 60.0})
    for (const double c : {0.0, 90.0, 270.0}) {
      EXPECT_NEAR(intensity_at(b, c, gamma) / intensity_at(a, c, gamma), 1, 0.01) << c << " " << gamma;
      EXPECT_NEAR(intensity_at(other, c, gamma) / intensity_at(a, c, gamma), 1, 0.1) << c << " " << gamma;
    }
  const auto none = run_sconce({"luminaire", "convert", path("lamp.glb"), "-o", path("x.exr")});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("luminaire field"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace sconce
