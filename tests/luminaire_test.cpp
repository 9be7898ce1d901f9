// SPDX-License-Identifier: Apache-2.0
// Measured lamps from file to baked lux, and the verb `luminaire`.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "bake_job.h"
#include "core/parallel.h"
#include "core/test_data.h"
#include "image/io.h"
#include "photometry/formats.h"
#include "photometry/light_field_file.h"
#include "picture/render.h"
#include "process.h"
#include "relight/moved_lamps.h"
#include "small_scenes.h"
#include "spots.h"

namespace sconce {
namespace {

using test::run_sconce;
using test::spots;

constexpr double kPiD = 3.14159265358979323846;

/// Bakes a scene file with its side file, direct light only unless said otherwise.
Package baked(const std::filesystem::path& scene, const std::filesystem::path& package, float density,
              int samples, int bounces, const char* solver = "radiosity") {
  app::BakeJob job;
  job.scene = scene;
  job.solver = solver;
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

/// What the floor shows of a package with a camera just above it: lux, green.
class Floor {
 public:
  Floor(const Package& package, float albedo)
      : view_(package),
        mix_(make_mix(package.manifest().groups, {}, "", {})),
        pages_(mix_pages(package, mix_)),
        albedo_(static_cast<double>(albedo)) {}

  double lux(float x, float z) const {
    Camera camera = look_at(Vec3(x, 1, z), Vec3(x + 0.001f, 0, z));
    camera.yfov = 0.002f;
    camera.aspect = 1;
    return static_cast<double>(view_.render(camera, mix_, pages_, {1, 1, 16, 0}).rgb_at(0, 0).g) * kPiD /
           albedo_;
  }
  const View& view() const { return view_; }

 private:
  View view_;
  MixSpec mix_;
  std::vector<Image> pages_;
  double albedo_;
};

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
  const Floor floor(package, albedo);
  for (const auto& [x, z] :
       {std::pair(0.3f, 0.01f), std::pair(1.2f, 0.5f), std::pair(-1.0f, -0.7f), std::pair(0.0f, 1.5f)}) {
    const glm::dvec3 to(x - 0.3, -2, z);
    const double d2 = glm::dot(to, to), cosine = 2 / std::sqrt(d2);
    // Roll turns C0 from +x towards -z.
    const double c = std::atan2(-to.z, to.x) * 180 / kPiD - 20;
    const double candela = 0.5 * intensity_at(lamp, std::fmod(c + 720, 360), std::acos(cosine) * 180 / kPiD);
    EXPECT_NEAR(floor.lux(x, z) / (candela * cosine / d2), 1, 2e-3) << x << " " << z;
  }
}

// A light field baked into a group is on the floor what `luminaire render` throws onto a wall, whoever
// solves; and what relighting has for its direct light.
TEST(LuminaireBake, LightFieldIsWhatRenderShows) {
  const TemporaryFolder folder;
  Scene scene;
  const float albedo = 0.5f;
  add_quad(scene, "floor", add_material(scene, "grey", Rgb(albedo)), Vec3(-0.5f, 0, -0.5f), Vec3(0, 0, 1),
           Vec3(1, 0, 0));
  folder.write("floor.glb", write_glb(scene, "test"));
  write_light_field(folder / "lamp.exr", spots());
  folder.write("floor.toml", "[[luminaire]]\nfile = \"lamp.exr\"\nat = [0, 0.3, 0]\n");
  const auto run =
      run_sconce({"luminaire", "render", (folder / "lamp.exr").string(), "-o", (folder / "wall.exr").string(),
                  "--distance", "0.3", "--width", "0.6", "--size", "20", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Image wall = read_exr(folder / "wall.exr");
  for (const char* solver : {"path", "radiosity", "photon"}) {
    const Package package = baked(folder / "floor.glb", folder / "floor.sconce", 40, 512, 0, solver);
    ASSERT_TRUE(package.scene().luminaires.at(0).field) << "the package keeps the light field";
    const Floor floor(package, albedo);
    const MovedGroup group{Id<LightGroup>(0), Rgb(1)};
    const MovedLamps moved(floor.view().scene(), floor.view().world(), floor.view().tracer(), {},
                           {&group, 1});
    for (int j = 2; j < 20; j += 5)
      for (int i = 2; i < 20; i += 5) {
        const float x = (static_cast<float>(i) + 0.5f) * 0.03f - 0.3f,
                    z = (static_cast<float>(j) + 0.5f) * 0.03f - 0.3f;
        const auto expected = static_cast<double>(wall.at(i, j)[0]);
        EXPECT_NEAR(floor.lux(x, z), expected, 0.02 * expected) << solver << " " << x << " " << z;
        double relit = 0;
        for (uint32_t k = 0; k < 1024; ++k)
          relit +=
              static_cast<double>(moved.illuminance({Vec3(x, 0, z), Vec3(0, 1, 0), Vec3(0, 1, 0)}, 1, k).g) /
              1024;
        EXPECT_NEAR(relit, expected, 0.02 * expected) << x << " " << z;
      }
  }
}

// Twice the light twice the lux, to the bit; and the same bits at any number of threads.
TEST(LuminaireBake, LightFieldsAreLinear) {
  const TemporaryFolder folder;
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.5f)), Vec3(-0.5f, 0, -0.5f),
          Vec3(0.5f, 0.5f, 0.5f), true);
  folder.write("room.glb", write_glb(scene, "test"));
  write_light_field(folder / "lamp.exr", spots());
  const auto layer = [&](const char* dim, int threads) {
    folder.write("room.toml",
                 std::string("[[luminaire]]\nfile = \"lamp.exr\"\nat = [0, 0.4, 0]\ndim = ") + dim + "\n");
    const ThreadLimit limit(threads);
    const Package package = baked(folder / "room.glb", folder / "room.sconce", 8, 8, -1);
    return package.layer(0, 0).data;
  };
  const auto one = layer("1", 1), two = layer("2", 2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(2 * one[i], two[i]);
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

// The same for a light field whose dual has negative lobes, a third of all light: whoever samples or traces
// it by size and keeps the sign has its flux, bounces included.
TEST(LuminaireBake, LightFieldOfBothSignsInAWhiteSphere) {
  const TemporaryFolder folder;
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.5f)), Vec3(0), 3, 48, true);
  folder.write("sphere.glb", write_glb(scene, "test"));
  LightField field = test::colored_spots();
  double absolute = 0;
  for (std::size_t i = 0; i < field.color.size(); ++i) {
    const std::size_t term = i / field.pixels() % field.terms();
    if (term % 4 == 1) field.color[i] *= -1.3f;
    absolute += std::abs(static_cast<double>(field.color[i]));
  }
  set_luminance(field);
  double sum = 0;
  for (const float v : field.color) sum += static_cast<double>(v);
  ASSERT_LT(sum, 0.7 * absolute) << "signs cancel";
  ASSERT_GT(sum, 0.1 * absolute);
  write_light_field(folder / "lamp.exr", field);
  folder.write("sphere.toml", "[[luminaire]]\nfile = \"lamp.exr\"\nat = [0, 0, 0]\n");
  for (const char* solver : {"path", "radiosity", "photon"}) {
    const Package package = baked(folder / "sphere.glb", folder / "sphere.sconce", 4, 256, -1, solver);
    const GroupInfo& group = package.manifest().groups.at(0);
    EXPECT_NEAR(group.lumens, flux(field), 1e-3 * flux(field)) << solver;
    EXPECT_NEAR(group.mean_lux / (flux(field) / (4 * kPiD * 9 * 0.5)), 1, 0.02) << solver;
  }
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
  const std::string png = (folder / "isolux.png").string();
  EXPECT_EQ(run_sconce({"luminaire", "check", ldt, "--isolux", png, "--quiet"}).code, 0);
  EXPECT_EQ(read_image(png).width, 1000);
  EXPECT_EQ(run_sconce({"luminaire", "check", ldt, ies, ldt, "--png", "--diagram", (folder / "all").string(),
                        "--quiet"})
                .code,
            0);
  for (const char* name : {"sample4.png", "out.png", "sample4 2.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "all" / name)) << name;
  EXPECT_EQ(run_sconce({"luminaire", "check", ldt, "--diagram", (folder / "x.gif").string()}).code, 2);
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
  EXPECT_EQ(run_sconce({"luminaire", "field", rays, "-o", path("x.exr"), "--coding", "rgbe"}).code, 2);
}

// Light fields in colours: whatever the coding, the same flux and the same colours on a wall.
TEST(LuminaireVerb, LightFieldsConvert) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder / name).string(); };
  const LightField field = test::colored_spots();
  write_light_field(path("float.exr"), field);
  const auto wall = [&](const std::string& name) {
    const auto run = run_sconce(
        {"luminaire", "render", path(name), "-o", path("wall.exr"), "--distance", "0.5", "--size", "8"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("predicted error"), std::string::npos) << run.out;
    return read_exr(path("wall.exr"));
  };
  const Image truth = wall("float.exr");
  const float brightest = *std::max_element(truth.data.begin(), truth.data.end());
  const Rgb middle = truth.rgb_at(2, 4);
  EXPECT_GT(middle.r, 2 * middle.b);
  for (const std::string coding : {"half", "srgbe"}) {
    const auto run = run_sconce({"luminaire", "convert", path("float.exr"), "--coding", coding, "-o",
                                 path(coding + ".exr"), "--json"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NEAR(nlohmann::json::parse(run.out).at("lumens").get<double>(), flux(field), 2e-3 * flux(field));
    EXPECT_LT(std::filesystem::file_size(path(coding + ".exr")),
              0.7 * static_cast<double>(std::filesystem::file_size(path("float.exr"))));
    const Image coded = wall(coding + ".exr");
    for (std::size_t i = 0; i < truth.data.size(); ++i)
      EXPECT_NEAR(coded.data[i], truth.data[i], 0.01f * brightest) << coding;
  }
  const auto scaled = run_sconce(
      {"luminaire", "convert", path("half.exr"), "--lumens", "100", "-o", path("100.exr"), "--json"});
  ASSERT_EQ(scaled.code, 0) << scaled.err;
  EXPECT_NEAR(nlohmann::json::parse(scaled.out).at("lumens").get<double>(), 100, 1e-3);
  EXPECT_FALSE(read_light_field(path("100.exr")).is_grey());
  const auto wrong = run_sconce({"luminaire", "convert", path("wall.exr"), "-o", path("x.exr")});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_NE(wrong.err.find("wall.exr"), std::string::npos) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(path("x.exr")));
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

// A modelled luminaire to a light field and its far field: an emitter of 10 x 20 mm, 3 lm.
TEST(LuminaireVerb, FieldOfAScene) {
  const TemporaryFolder folder;
  Scene scene;
  const float lumens = 3, area = 0.01f * 0.02f;
  add_quad(scene, "led", add_material(scene, "led", Rgb(0), Rgb(lumens / (kPi * area))),
           Vec3(-0.005f, 0, -0.01f), Vec3(0.01f, 0, 0), Vec3(0, 0, 0.02f));
  folder.write("led.glb", write_glb(scene, "test"));
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto run =
      run_sconce({"luminaire", "field", path("led.glb"), "-o", path("led.exr"), "--far", path("led.ies"),
                  "--basis", "bell", "--angle", "60", "--pixels", "16", "--rays", "100000", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("columns"), 5) << "2 spacings and what duals reach beyond";
  EXPECT_EQ(json.at("rows"), 7);
  EXPECT_NEAR(json.at("lumens").get<double>(), 3 * 0.75, 0.01) << "within 60 degrees are three quarters";
  const Photometry far = read_photometry(path("led.ies"));
  EXPECT_NEAR(flux(far), 3, 1e-4);
  EXPECT_NEAR(intensity_at(far, 0, 30), 3 / kPiD * std::cos(kPiD / 6), 0.05);
  EXPECT_EQ(run_sconce({"luminaire", "field", path("led.glb"), "-o", path("x.exr"), "--rays", "0"}).code, 2);
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
