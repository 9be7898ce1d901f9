// SPDX-License-Identifier: Apache-2.0
// Measured lamps from file to baked lux, and the verb `luminaire`.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "bake_job.h"
#include "core/test_data.h"
#include "image/io.h"
#include "photometry/formats.h"
#include "picture/render.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

using test::run_sconce;

constexpr double kPiD = 3.14159265358979323846;

/// Bakes a scene file with its side file, direct light only unless said otherwise.
Package baked(const std::filesystem::path& scene, const std::filesystem::path& package, float density,
              int samples, int bounces) {
  app::BakeJob job;
  job.scene = scene;
  job.atlas.density = density;
  job.params.samples = samples;
  job.params.bounces = bounces;
  job.encoding = "f32";
  const app::PreparedBake bake(job, {});
  BakeState state = BakeState::create(scene.parent_path() / "state", bake.header());
  app::run_bake(bake, {}, state, {});
  app::write_result(bake, std::span(&state, 1), package, {}, {});
  return Package::open(package);
}

/// 800 cd at nadir, 300 at 45 degrees, 0 at the horizon; another half of it at C90.
const char* kLamp =
    "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1 -1 1 4 2 1 2 0 0 0\n1 1 30\n0 30 60 90\n0 90\n800 600 200 "
    "0\n800 400 100 0\n";

// E = I(C, gamma) cos(gamma) / d2 on the floor, from a side file through import, bake, package and picture.
TEST(LuminaireBake, LuxOnTheFloor) {
  const TemporaryFolder folder;
  Scene scene;
  const float albedo = 0.5f;
  add_quad(scene, "floor", add_material(scene, "grey", Rgb(albedo)), Vec3(-2, 0, -2), Vec3(0, 0, 4),
           Vec3(4, 0, 0));
  folder.write("floor.glb", write_glb(scene, "test"));
  folder.write("lamp.ies", kLamp);
  folder.write("floor.toml", "[[luminaire]]\nfile = \"lamp.ies\"\nat = [0.3, 2, 0]\nroll = 20\ndim = 0.5\n");
  const Package package = baked(folder / "floor.glb", folder / "floor.sconce", 60, 16, 0);
  EXPECT_EQ(package.scene().luminaires.size(), 1u) << "the package keeps the lamp";
  const Photometry lamp = parse_ies(kLamp, "lamp.ies");
  const View view(package);
  const MixSpec mix = make_mix(package.manifest().groups, {}, "", {});
  const std::vector<Image> pages = mix_pages(package, mix);
  for (const auto& [x, z] :
       {std::pair(0.3f, 0.01f), std::pair(1.2f, 0.5f), std::pair(-1.0f, -0.7f), std::pair(0.0f, 1.5f)}) {
    Camera camera = look_at(Vec3(x, 1, z), Vec3(x + 0.001f, 0, z));
    camera.yfov = 0.002f;
    camera.aspect = 1;
    const double seen = static_cast<double>(view.render(camera, mix, pages, {1, 1, 16, 0}).rgb_at(0, 0).g);
    const glm::dvec3 to(x - 0.3, -2, z);
    const double d2 = glm::dot(to, to), cosine = 2 / std::sqrt(d2);
    // Roll turns C0 from +x towards -z.
    const double c = std::atan2(-to.z, to.x) * 180 / kPiD - 20;
    const double candela = 0.5 * intensity_at(lamp, std::fmod(c + 720, 360), std::acos(cosine) * 180 / kPiD);
    const double lux = seen * kPiD / static_cast<double>(albedo);
    EXPECT_NEAR(lux / (candela * cosine / d2), 1, 2e-3) << x << " " << z;
  }
}

// Within a sphere every surface gets the same share of all light: E = flux / (4 pi R2 (1 - albedo)). So what
// is rendered is what the file states.
TEST(LuminaireBake, FluxInAWhiteSphere) {
  const auto file = test_data() / "photometry/ldt/eulumdat-py/sample4.ldt";
  SCONCE_NEEDS_DATA(file);
  const TemporaryFolder folder;
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.5f)), Vec3(0), 3, 48, true);
  folder.write("sphere.glb", write_glb(scene, "test"));
  folder.write("lamp.ldt", read_file(file));
  folder.write("sphere.toml", "[[luminaire]]\nfile = \"lamp.ldt\"\nat = [0, 0, 0]\n");
  const Package package = baked(folder / "sphere.glb", folder / "sphere.sconce", 4, 256, -1);
  const GroupInfo& group = package.manifest().groups.at(0);
  EXPECT_NEAR(group.lumens, 5540, 0.005 * 5540) << "the flux that the maker states";
  EXPECT_NEAR(group.mean_lux, 5540 / (4 * kPiD * 9 * 0.5), 0.01 * group.mean_lux);
}

TEST(LuminaireVerb, InfoCheckConvert) {
  const auto data = test_data() / "photometry";
  SCONCE_NEEDS_DATA(data);
  const TemporaryFolder folder;
  const std::string ldt = (data / "ldt/eulumdat-py/sample4.ldt").string(),
                    ies = (folder / "out.ies").string();
  const auto info = run_sconce({"luminaire", "info", ldt, "--json"});
  ASSERT_EQ(info.code, 0) << info.err;
  const auto json = nlohmann::json::parse(info.out);
  EXPECT_EQ(json.at("symmetry"), "in quadrants");
  EXPECT_NEAR(json.at("lumens").get<double>(), 5540, 28);

  EXPECT_EQ(run_sconce({"luminaire", "convert", ldt, "-o", ies}).code, 0);
  const Photometry before = read_photometry(ldt), after = read_photometry(ies);
  EXPECT_EQ(after.candela, before.candela);

  const std::string svg = (folder / "polar.svg").string();
  const auto well = run_sconce({"luminaire", "check", ldt, ies, "--ugr"});
  EXPECT_EQ(well.code, 0) << well.out;
  EXPECT_NE(well.out.find("2H x 2H"), std::string::npos);
  EXPECT_EQ(run_sconce({"luminaire", "check", ldt, "--diagram", svg, "--quiet"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(svg));
  const auto ill =
      run_sconce({"luminaire", "check", (data / "ldt/eulumdat-ugr/input/sample_05.ldt").string()});
  EXPECT_EQ(ill.code, 3);
  EXPECT_NE(ill.out.find("warning: integrates to"), std::string::npos);

  const std::string rays = (data / "tm25/Cyl10k.1.tm25ray").string();
  EXPECT_EQ(run_sconce({"luminaire", "convert", rays, "-o", ies, "--lumens", "800"}).code, 0);
  EXPECT_NEAR(flux(read_photometry(ies)), 800, 1e-6);
  const auto copied =
      run_sconce({"luminaire", "convert", rays, "-o", (folder / "copy.tm25ray").string(), "--json"});
  ASSERT_EQ(copied.code, 0) << copied.err;
  EXPECT_NEAR(nlohmann::json::parse(copied.out).at("lumens").get<double>(), 10000, 1e-2);
  const auto again = run_sconce({"luminaire", "info", (folder / "copy.tm25ray").string(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(again.out).at("rays").get<int>(), 10000);
}

// Rays to a light field to a wall: the light field lights it as the rays do, from near, where their far field
// does not.
TEST(LuminaireVerb, FieldAndRender) {
  const auto rays = (test_data() / "photometry/tm25/Cyl10k.1.tm25ray").string();
  SCONCE_NEEDS_DATA(rays);
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto field = run_sconce(
      {"luminaire", "field", rays, "-o", path("lamp.exr"), "--angle", "50", "--pixels", "32", "--json"});
  ASSERT_EQ(field.code, 0) << field.err;
  const auto json = nlohmann::json::parse(field.out);
  EXPECT_NEAR(json.at("lumens").get<double>() + json.at("lumens_lost").get<double>(), 10000, 1);
  // The sampling plane lies below the cylinder, 20 mm from its origin: walls at the same place.
  EXPECT_NEAR(json.at("plane").get<double>(), -0.02, 1e-4);
  const auto wall = [&](const std::string& file, const char* distance, const char* out) {
    const auto run = run_sconce({"luminaire", "render", file, "-o", path(out), "--distance", distance,
                                 "--width", "0.06", "--size", "12", "--json"});
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out).at("lumens").get<double>();
  };
  EXPECT_EQ(run_sconce({"luminaire", "convert", rays, "-o", path("far.ies")}).code, 0);
  const double landed = wall(rays, "0.07", "rays.exr"), near = wall(path("lamp.exr"), "0.05", "near.exr");
  EXPECT_NEAR(near / landed, 1, 0.05) << "some 500 rays";
  EXPECT_GT(std::abs(wall(path("far.ies"), "0.07", "far.exr") / landed - 1), 0.1);
  EXPECT_EQ(
      run_sconce({"luminaire", "render", path("lamp.exr"), "-o", path("wall.png"), "--size", "4", "--quiet"})
          .code,
      0);
  EXPECT_EQ(run_sconce({"luminaire", "convert", path("lamp.exr"), "-o", path("by-product.ies")}).code, 0);
  EXPECT_NEAR(flux(read_photometry(path("by-product.ies"))) / json.at("lumens").get<double>(), 1, 0.1);
  EXPECT_EQ(run_sconce({"luminaire", "field", rays, "-o", path("x.exr"), "--basis", "box"}).code, 2);
}

// Four flat photographs of a screen: 0.5 x 8 lux on 0.1 x 0.1 m each.
TEST(LuminaireVerb, Acquire) {
  const TemporaryFolder folder;
  folder.write(
      "acquire.toml",
      "[filter]\ncolumns = 2\nrows = 2\nspacing = 5\n[plane]\ndistance = 100\nwidth = 100\npixels = "
      "10\n[camera]\n"
      "corners = [[0, 40], [40, 40], [40, 0], [0, 0]]\nlux = 8\n[pictures]\nname = \"{m}-{n}.exr\"\n");
  Image flat = Image::rgb(40, 40);
  std::fill(flat.data.begin(), flat.data.end(), 0.5f);
  const std::string lamp = (folder / "lamp.exr").string(), dir = folder.path().string();
  for (const char* name : {"0-0.exr", "1-0.exr", "0-1.exr"}) write_exr(folder / name, flat, PixelType::full);
  const auto early = run_sconce({"luminaire", "acquire", dir, "-o", lamp});
  EXPECT_EQ(early.code, 1);
  EXPECT_NE(early.err.find("1-1.exr: is missing: 3 of 4 positions are there"), std::string::npos)
      << early.err;
  std::thread camera([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    write_exr(folder / "1-1.exr", flat, PixelType::full);
  });
  const auto watched = run_sconce({"luminaire", "acquire", dir, "-o", lamp, "--watch", "--json"});
  camera.join();
  ASSERT_EQ(watched.code, 0) << watched.err;
  EXPECT_NEAR(nlohmann::json::parse(watched.out).at("lumens").get<double>(), 4 * 4 * 0.01, 1e-6);
  EXPECT_TRUE(std::filesystem::exists(lamp + ".preview.png"));
  EXPECT_EQ(run_sconce(
                {"luminaire", "render", lamp, "-o", (folder / "wall.exr").string(), "--size", "4", "--quiet"})
                .code,
            0);
}

TEST(LuminaireVerb, BadInput) {
  const auto data = test_data() / "photometry";
  SCONCE_NEEDS_DATA(data);
  const auto cut =
      run_sconce({"luminaire", "info", (data / "ies/ies_rescale/Truncated Profile - 01.IES").string()});
  EXPECT_EQ(cut.code, 1);
  EXPECT_NE(cut.err.find("Truncated Profile - 01.IES:25: ends before"), std::string::npos) << cut.err;
  const auto action = run_sconce({"luminaire", "chek"});
  EXPECT_EQ(action.code, 2);
  EXPECT_NE(action.err.find("did you mean 'check'?"), std::string::npos) << action.err;
  EXPECT_EQ(
      run_sconce({"luminaire", "convert", (data / "ldt/eulumdat-py/sample4.ldt").string(), "-o", "x.txt"})
          .code,
      2);
  EXPECT_EQ(run_sconce({"luminaire"}).code, 2);
  EXPECT_EQ(run_sconce({"luminaire", "--help"}).code, 0);
}

}  // namespace
}  // namespace sconce
