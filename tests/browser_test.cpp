// SPDX-License-Identifier: Apache-2.0
// The page in the distribution's headless browser: its canvas shows the CPU's picture, by every set of layers
// and after faders were moved; it is usable by keyboard and says what is missing (web/test).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bumpy_room.h"
#include "core/test_data.h"
#include "image/io.h"
#include "package/test_package.h"
#include "process.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace sconce {
namespace {

class Browser : public testing::Test {
 protected:
  void SetUp() override {
    if (test::can_browse() && fs::exists(fs::path(SCONCE_PROGRAM).parent_path() / "web/index.html")) return;
    constexpr const char* kMissing = "node, chromium or the page ('make web') is absent";
    if (test_data_required()) FAIL() << kMissing;
    GTEST_SKIP() << kMissing;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void run(const std::vector<std::string>& args) const {
    const test::Outcome outcome = test::run_sconce(args);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  void bake(const std::string& scene, const std::vector<std::string>& more) const {
    std::vector<std::string> args{"bake", scene, "-o", path("x.sconce"), "--quiet"};
    args.insert(args.end(), more.begin(), more.end());
    run(args);
  }
  static test::Outcome node(const std::string& script, const std::vector<std::string>& args) {
    std::vector<std::string> words{SCONCE_SOURCE_DIR "/web/test/" + script};
    words.insert(words.end(), args.begin(), args.end());
    return test::run_program("node", words);
  }

  struct Case {
    std::string query;
    Json steps;                         ///< in the browser
    std::vector<std::string> settings;  ///< the same for `sconce render`
  };
  /// @return the browser's report of each case
  Json compare(const std::vector<Case>& cases) const {
    Json pictures = Json::array();
    for (std::size_t i = 0; i < cases.size(); ++i)
      pictures.push_back({{"query", cases[i].query},
                          {"file", path("web" + std::to_string(i) + ".png")},
                          {"steps", cases[i].steps}});
    const test::Outcome outcome = node("pictures.mjs", {path("site"), pictures.dump()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    if (outcome.code != 0) return Json::array();
    const Json report = Json::parse(outcome.out);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      SCOPED_TRACE(cases[i].query + " " + cases[i].steps.dump());
      EXPECT_EQ(report[i]["state"], "ready");
      EXPECT_EQ(report[i]["errors"], Json::array());
      std::vector<std::string> args{"render", path("x.sconce"), "--device", "cpu", "--size", "800x450",
                                    "-o",     path("cpu.png"),  "--quiet"};
      args.insert(args.end(), cases[i].settings.begin(), cases[i].settings.end());
      run(args);
      expect_alike(path("web" + std::to_string(i) + ".png"), path("cpu.png"));
    }
    return report;
  }
  static Image8 codes(const std::string& file) {
    const std::string bytes = read_file(file);
    return decode_image8({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, file);
  }
  /// Per channel, in codes.
  static double mean_difference(const Image8& a, const Image8& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    double difference = 0;
    const auto pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        difference += std::abs(int{a.data[i * static_cast<std::size_t>(a.channels) + c]} -
                               int{b.data[i * static_cast<std::size_t>(b.channels) + c]});
    return difference / static_cast<double>(3 * pixels);
  }
  void expect_alike(const std::string& a_file, const std::string& b_file) const {
    const Image8 a = codes(a_file);
    const double difference = mean_difference(a, codes(b_file));
    EXPECT_LE(difference, 2) << "mean, in codes";
    EXPECT_GT(mean_difference(a, {a.width, a.height, 3, std::vector<unsigned char>(a.data.size())}), 16)
        << "too dark to compare";
    RecordProperty(("mean_codes_" + fs::path(a_file).stem().string()).c_str(), std::to_string(difference));
  }
  TemporaryFolder folder_;
};

Json press(const std::string& label, const std::string& key, int times) {
  return {"press", label, key, times};
}

// Every tier; faders, colours and switches; every kind of exposure and curve.
TEST_F(Browser, BathroomLooksAsOnTheCpu) {
  bake(SCONCE_SOURCE_DIR "/scenes/bathroom.glb", {"--atlas", "512", "--samples", "4", "--bounces", "2"});
  run({"export", path("x.sconce"), "--web", path("site"), "--tiers", "full,half,unfiltered,byte", "--quiet"});
  std::vector<Case> cases;
  for (const char* tier : {"full", "half", "unfiltered", "byte"})
    cases.push_back({std::string("tier=") + tier, Json::array(), {}});
  cases.push_back({"tier=half",
                   {press("mirror brightness, in stops", "ArrowRight", 15),
                    {"click", "window on"},
                    {"select", "ceiling colour", "kelvin"},
                    {"select", "Tone curve", "drago"}},
                   {"mirror=+1.5ev", "window=off", "ceiling=2700K", "--tone", "drago"}});
  cases.push_back({"tier=byte",
                   {{"click", "mirror alone"},
                    press("Exposure, in stops from automatic", "ArrowLeft", 10),
                    {"select", "Tone curve", "reinhard"}},
                   {"--others", "off", "mirror=on", "--exposure", "-1", "--tone", "reinhard"}});
  const Json report = compare(cases);
  ASSERT_EQ(report.size(), cases.size());
  // Four small layers; three.js and the pictures on the walls are most of the rest.
  std::size_t layers = 0;
  for (const auto& entry : fs::directory_iterator(path("x.sconce") + "/layers")) layers += entry.file_size();
  EXPECT_LE(report[1]["bytes"].get<double>(), 1.5 * static_cast<double>(layers));
  RecordProperty("share_of_layers",
                 std::to_string(report[1]["bytes"].get<double>() / static_cast<double>(layers)));
}

// Pages share arrays, and so do more layers than there are texture units; luminances share textures.
TEST_F(Browser, PagesManyLayersAndLuminances) {
  struct Kind {
    int groups, pages;
    const char* encoding;
  };
  for (const Kind& kind :
       {Kind{3, 2, "f16"}, {3, 2, "bc6h"}, {16, 1, "exp8"}, {5, 2, "lum:f16"}, {6, 1, "lum:multi8"}}) {
    SCOPED_TRACE(kind.encoding);
    PackageContents contents = test_package(kind.groups, kind.pages, 32, 32);
    contents.manifest.instance_pages = {kind.pages - 1};
    contents.encodings.assign(static_cast<std::size_t>(kind.groups), kind.encoding);
    for (GroupInfo& group : contents.manifest.groups) group.color = Rgb(0.55f, 1.1f, 1.65f);
    write_package(path("x.sconce"), contents);
    const bool blocks = std::string_view(kind.encoding) == "bc6h";  // as stored, by the best tier alone
    run({"export", path("x.sconce"), "--web", path("site"), "--tiers", blocks ? "full" : "half,byte",
         "--quiet"});
    std::vector<Case> cases;
    if (blocks) {
      cases = {{"tier=full", {press("b brightness, in stops", "ArrowLeft", 10)}, {"b=-1ev"}}};
    } else {
      cases = {{"tier=half", {press("a brightness, in stops", "ArrowLeft", 20)}, {"a=-2ev"}},
               {"tier=byte", {press("c brightness, in stops", "ArrowRight", 10)}, {"c=+1ev"}}};
    }
    compare(cases);
  }
}

// Directional layers show normal maps in every tier, and follow their faders.
TEST_F(Browser, NormalMaps) {
  const std::string scene = folder_.write("bumpy.glb", write_glb(test::bumpy_room(), "test"));
  const std::vector<std::string> words{"--atlas", "256", "--samples", "16", "--bounces", "1", "--basis"};
  const auto bake_by = [&](const char* basis) {
    std::vector<std::string> all = words;
    all.push_back(basis);
    bake(scene, all);
  };
  bake_by("flat");
  run({"render", path("x.sconce"), "--device", "cpu", "--size", "800x450", "-o", path("flat.png"),
       "--quiet"});
  bake_by("sh1");
  run({"export", path("x.sconce"), "--web", path("site"), "--tiers", "full,half,unfiltered,byte", "--quiet"});
  std::vector<Case> cases;
  for (const char* tier : {"full", "half", "unfiltered", "byte"})
    cases.push_back({std::string("tier=") + tier, Json::array(), {}});
  cases.push_back({"tier=half",
                   {press("left brightness, in stops", "ArrowRight", 10), {"click", "right on"}},
                   {"left=+1ev", "right=off"}});
  compare(cases);
  EXPECT_GT(mean_difference(codes(path("web0.png")), codes(path("flat.png"))), 4);
  const auto signless =
      test::run_sconce({"export", path("x.sconce"), "--web", path("no"), "--encoding", "exp8", "--quiet"});
  EXPECT_EQ(signless.code, 2);
  EXPECT_NE(signless.err.find("exp8 cannot hold the signed basis sh1"), std::string::npos) << signless.err;
  run({"export", path("x.sconce"), "--web", path("site"), "--encoding", "srgbe8", "--quiet"});
  compare({{"tier=half", Json::array(), {}}});
}

// The middle pixel of a ball before the camera is what a surface there receives that faces it, between the
// same probes.
TEST_F(Browser, ABallTakesTheMixFromProbes) {
  const std::string scene = folder_.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  bake(scene, {"--atlas", "64", "--samples", "64", "--probes", "0.5"});
  run({"export", path("x.sconce"), "--web", path("site"), "--quiet"});
  const test::Outcome outcome =
      node("ball.mjs", {path("site"), "ball=0,1,0.2,0.2", "left brightness, in stops", "ArrowLeft", "20"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json found = Json::parse(outcome.out);
  EXPECT_EQ(found["errors"], Json::array());
  const auto probed = [&](const char* setting) {
    const test::Outcome probe =
        test::run_sconce({"probe", path("x.sconce"), "--at", "0,1,0.2,0,0,1", "--probes", "--json", setting});
    EXPECT_EQ(probe.code, 0) << probe.err;
    return Json::parse(probe.out)["lux"]["average"].get<double>();
  };
  // The page says two digits below 100 lx, three above; the ball has 48 x 24 faces.
  EXPECT_NEAR(found["before"].get<double>(), probed("left=1"), 0.05 * probed("left=1"));
  EXPECT_NEAR(found["after"].get<double>(), probed("left=-2ev"), 0.05 * probed("left=-2ev"));
  EXPECT_LT(found["after"].get<double>(), 0.8 * found["before"].get<double>());
}

// A sky is seen, and follows its fader.
TEST_F(Browser, Sky) {
  const std::string scene = folder_.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  folder_.write("room.toml", "[sky]\nluminance = 20\n");
  bake(scene, {"--atlas", "64", "--samples", "4"});
  run({"export", path("x.sconce"), "--web", path("site"), "--quiet"});
  compare({{"tier=half", {press("sky brightness, in stops", "ArrowLeft", 20)}, {"sky=-2ev"}}});
}

// Coloured glass before a veil, over most of the picture; a fader moves what is behind them.
TEST_F(Browser, PanesLetThrough) {
  Scene room = test::two_lamp_room();
  Material glass, veil;
  glass.name = "glass", glass.base_color = Rgb(0.9f, 0.6f, 0.3f), glass.transmission = 0.9f;
  veil.name = "veil", veil.base_color = Rgb(0.4f), veil.alpha_mode = Material::Alpha::blend,
  veil.alpha = 0.4f;
  glass.double_sided = veil.double_sided = true;
  for (const auto& [material, x, z] : {std::tuple{glass, -0.95f, 0.1f}, {veil, -0.55f, 0}}) {
    room.materials.push_back(material);
    add_quad(room, material.name, Id<Material>(room.materials.size() - 1), Vec3(x, 0.1f, z), Vec3(1.5f, 0, 0),
             Vec3(0, 1.6f, 0));
  }
  bake(folder_.write("panes.glb", write_glb(room, "test")), {"--atlas", "256", "--samples", "64"});
  run({"export", path("x.sconce"), "--web", path("site"), "--quiet"});
  compare({{"tier=half", Json::array(), {}},
           {"tier=byte", {press("left brightness, in stops", "ArrowLeft", 20)}, {"left=-2ev"}}});
  // Opaque panes would be seen.
  for (std::size_t m = room.materials.size() - 2; m < room.materials.size(); ++m)
    room.materials[m].transmission = 0, room.materials[m].alpha_mode = Material::Alpha::opaque;
  bake(folder_.write("walls.glb", write_glb(room, "test")), {"--atlas", "256", "--samples", "8"});
  run({"render", path("x.sconce"), "--device", "cpu", "--size", "800x450", "-o", path("walls.png"),
       "--quiet"});
  EXPECT_GT(mean_difference(codes(path("web0.png")), codes(path("walls.png"))), 4);
}

TEST_F(Browser, IsUsableAndSaysWhatIsMissing) {
  bake(SCONCE_SOURCE_DIR "/scenes/bathroom.glb", {"--atlas", "256", "--samples", "1", "--bounces", "1"});
  const std::string preset = folder_.write("dim.toml", "[mix]\nceiling = \"-2ev\"\n");
  run({"export", path("x.sconce"), "--web", path("site"), "--preset", preset, "--quiet"});
  const test::Outcome outcome = node("page.mjs", {path("site")});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace sconce
