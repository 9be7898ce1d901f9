// SPDX-License-Identifier: Apache-2.0
// The verbs mix and render on a package whose content is known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "image/io.h"
#include "mix/mix.h"
#include "package/test_package.h"
#include "process.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

using test::Outcome;
using test::run_sconce;

/// Two groups, 100 and 20 lux of grey, on a grey wall (albedo 0.5) that fills the camera's view.
class MixRender : public testing::Test {
 protected:
  void SetUp() override { write(1); }
  void write(int pages) {
    PackageContents c = test_package(2, pages, 8, 8);
    for (std::size_t g = 0; g < 2; ++g)
      for (Image& page : c.layers[g])
        for (float& v : page.data) v = g == 0 ? 100.0f : 20.0f;
    write_package(package(), c);
  }
  std::string package() const { return path("wall.sconce"); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Outcome run(std::vector<std::string> args) const {
    args.insert(args.begin() + 1, package());
    return run_sconce(args);
  }
  void expect_error(const std::vector<std::string>& args, int code, const std::string& said) const {
    const Outcome outcome = run(args);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  std::size_t files() const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_ / "")) ++n;
    return n;
  }
  TemporaryFolder folder_;
};

constexpr float kLuminance = 0.5f * kInvPi;  // of the wall, per lux

TEST_F(MixRender, LightmapIsTheWeightedSum) {
  ASSERT_EQ(run({"mix", "a=0.5", "--others", "+1ev", "-o", path("m.exr")}).code, 0);
  const Image mixed = read_exr(path("m.exr"));
  EXPECT_EQ(mixed.width, 8);
  EXPECT_EQ(mixed.text.at("sconce:unit"), "lux");
  EXPECT_NE(mixed.text.at("sconce:convention").find("albedo * E / pi"), std::string::npos);
  for (const float v : mixed.data) EXPECT_EQ(v, 90.0f);
}

TEST_F(MixRender, SeveralPagesAreNumbered) {
  write(2);
  ASSERT_EQ(run({"mix", "-o", path("m.exr")}).code, 0);
  EXPECT_EQ(read_exr(path("m.1.exr")).data.front(), 120.0f);
  EXPECT_TRUE(std::filesystem::exists(path("m.0.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("m.exr")));
}

// 120 lux on a white surface; the wall's own middle grey is 0.5 of that.
TEST_F(MixRender, LightmapForHardwareWithoutShaders) {
  write(2);
  ASSERT_EQ(run({"mix", "-o", path("m.png"), "--tone", "linear"}).code, 0);
  for (const std::string name : {"m.0.png", "m.1.png"}) {
    const Image page = read_image(path(name));
    EXPECT_EQ(page.width, 8);
    for (const float v : page.data) EXPECT_NEAR(v, 0.36f, 0.004f);
  }
  write(1);
  write_file(path("mood.toml"), "tone = \"linear\"\nexposure = \"-1\"\n[mix]\nb = \"off\"\n");
  ASSERT_EQ(run({"mix", "--preset", path("mood.toml"), "-o", path("p.png")}).code, 0);
  EXPECT_NEAR(read_image(path("p.png")).data[0], 0.18f, 0.003f);
  ASSERT_EQ(run({"render", "--device", "software", "--tone", "linear", "--size", "8", "--samples", "4", "-o",
                 path("s.png"), "--coverage", path("c.exr")})
                .code,
            0);
  // Codes of 0.36 and 0.5 multiplied.
  const float expected = srgb_to_linear(linear_to_srgb(0.36f) * linear_to_srgb(0.5f));
  for (const float v : read_image(path("s.png")).data) EXPECT_NEAR(v, expected, 0.004f);
  EXPECT_EQ(read_exr(path("c.exr")).data.front(), 0);
}

TEST_F(MixRender, LayeredPictureMixesToo) {
  Image image(2, 2, {"key.R", "key.G", "key.B", "fill.R", "fill.G", "fill.B"});
  for (float& v : image.data) v = 2;
  write_exr(path("render.exr"), image, PixelType::full);
  ASSERT_EQ(run_sconce({"mix", path("render.exr"), "fill=off", "key=3", "-o", path("m.exr")}).code, 0);
  EXPECT_EQ(read_exr(path("m.exr")).rgb_at(1, 1), Rgb(6));
  EXPECT_EQ(run_sconce({"mix", path("render.exr"), "fil=off", "-o", path("m.exr")}).code, 2);
  ASSERT_EQ(run_sconce({"mix", path("render.exr"), "--tone", "linear", "-o", path("m.png")}).code, 0);
  for (const float v : read_image(path("m.png")).data) EXPECT_NEAR(v, 0.18f, 0.002f);
}

TEST_F(MixRender, SequencesOfPictures) {
  for (int frame = 8; frame <= 11; ++frame) {
    Image image(2, 2, {"R", "G", "B", "RGBA_key.R", "RGBA_key.G", "RGBA_key.B"});
    for (std::size_t i = 0; i < image.data.size(); ++i)
      image.data[i] = static_cast<float>(i % 6 < 3 ? 3 * frame : frame);
    write_exr(path(fmt::format("shot.{:04}.exr", frame)), image, PixelType::full);
  }
  write_file(path("look.toml"), "[mix]\nkey = 4\nrest = \"off\"\n");
  const auto mix = [&](const std::string& frames, const std::string& output) {
    return run_sconce(
        {"mix", path("shot.%04d.exr"), "--frames", frames, "--preset", path("look.toml"), "-o", output});
  };
  ASSERT_EQ(mix("8-11", path("out.%d.exr")).code, 0);
  for (int frame = 8; frame <= 11; ++frame)
    EXPECT_EQ(read_exr(path(fmt::format("out.{}.exr", frame))).rgb_at(0, 0),
              Rgb(4 * static_cast<float>(frame)));
  // Brightening stays: exposure is the first frame's.
  ASSERT_EQ(mix("8-9", path("out.%d.png")).code, 0);
  EXPECT_GT(read_image(path("out.9.png")).data[0], 1.02f * read_image(path("out.8.png")).data[0]);
  std::filesystem::remove(path("out.11.exr"));
  const Outcome gap = mix("11-13", path("out.%d.exr"));
  EXPECT_EQ(gap.code, 1);
  EXPECT_NE(gap.err.find("shot.0012.exr: no such file, nor 1 more"), std::string::npos) << gap.err;
  EXPECT_FALSE(std::filesystem::exists(path("out.11.exr")));
  const Outcome over = mix("8-9", path("shot.%04d.exr"));
  EXPECT_EQ(over.code, 2);
  EXPECT_NE(over.err.find("light groups would be lost"), std::string::npos) << over.err;
  EXPECT_EQ(mix("12-11", path("out.%d.exr")).code, 2);
  EXPECT_EQ(mix("x", path("out.%d.exr")).code, 2);
  EXPECT_EQ(mix("8-9", path("out.exr")).code, 2);
}

TEST_F(MixRender, FramesThatAreNotAlikeAreTold) {
  write_exr(path("s1.exr"), Image(2, 2, {"R", "G", "B", "RGBA_a.R", "RGBA_a.G", "RGBA_a.B"}),
            PixelType::full);
  write_exr(path("s2.exr"), Image(3, 2, {"R", "G", "B", "RGBA_b.R", "RGBA_b.G", "RGBA_b.B"}),
            PixelType::full);
  const auto mix = [&](const std::string& setting) {
    return run_sconce({"mix", path("s%d.exr"), setting, "--frames", "1-2", "-o", path("o%d.exr")});
  };
  const Outcome all = mix("all=2");
  EXPECT_EQ(all.code, 0);
  EXPECT_NE(all.err.find("s2.exr: has the groups b, rest; the first frame has a, rest"), std::string::npos)
      << all.err;
  EXPECT_NE(all.err.find("s2.exr: is 3 x 2, the first frame 2 x 2"), std::string::npos) << all.err;
  const Outcome named = mix("a=2");
  EXPECT_EQ(named.code, 1);
  EXPECT_NE(named.err.find("s2.exr: unknown light group 'a'"), std::string::npos) << named.err;
}

TEST_F(MixRender, InfoListsTheGroupsOfPictures) {
  Image image(2, 2, {"R", "G", "B", "RGBA_key.R", "RGBA_key.G", "RGBA_key.B", "Z"});
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = i % 7 < 3 ? 4 : 1;
  write_exr(path("render.exr"), image, PixelType::full);
  const Outcome text = run_sconce({"info", path("render.exr")});
  EXPECT_EQ(text.code, 0);
  for (const char* word : {"Arnold", "key", "RGBA_key", "75.00 %", "Z"})
    EXPECT_NE(text.out.find(word), std::string::npos) << text.out;
  Image twice(2, 2, {"R", "G", "B", "RGBA_key.R", "RGBA_key.G", "RGBA_key.B", "N.X", "N.Y", "N.Z"});
  for (std::size_t i = 0; i < twice.data.size(); ++i) twice.data[i] = i % 9 < 3 ? 1 : 2;
  write_exr(path("twice.exr"), twice, PixelType::full);
  const Outcome over = run_sconce({"info", path("twice.exr")});
  for (const char* word : {"100.00 % more light", "in 100 % of the pixels", "N.XYZ\n"})
    EXPECT_NE(over.out.find(word), std::string::npos) << over.out;
  write_exr(path("plain.exr"), Image(2, 2, {"R", "G", "B", "N.R", "N.G", "N.B", "Z"}), PixelType::full);
  for (const char* verb : {"info", "mix"}) {
    const Outcome none = run_sconce(
        std::string(verb) == "info" ? std::vector<std::string>{verb, path("plain.exr")}
                                    : std::vector<std::string>{verb, path("plain.exr"), "-o", path("x.exr")});
    EXPECT_EQ(none.code, 1);
    EXPECT_NE(none.err.find("has no light-group layers among 'N'"), std::string::npos) << none.err;
    EXPECT_EQ(std::count(none.err.begin(), none.err.end(), '\n'), 1) << none.err;
  }
}

TEST_F(MixRender, LinearPictureHoldsCandelas) {
  ASSERT_EQ(run({"render", "b=off", "--size", "8x6", "--tone", "linear", "-o", path("x.exr")}).code, 0);
  const Image picture = read_exr(path("x.exr"));
  EXPECT_EQ(picture.width, 8);
  EXPECT_EQ(picture.height, 6);
  for (const float v : picture.data) EXPECT_NEAR(v, kLuminance * 100, 1e-3f);
}

TEST_F(MixRender, ExplicitExposureIsAppliedAndRecorded) {
  ASSERT_EQ(run({"render", "--size", "8", "--exposure", "+1", "-o", path("x.exr")}).code, 0);
  const Image picture = read_exr(path("x.exr"));
  EXPECT_EQ(picture.height, 8);  // the camera is square
  EXPECT_NEAR(picture.data.front(), 0.36f, 1e-3f);
  EXPECT_NEAR(picture.data.front() * picture.number.at("whiteLuminance"), kLuminance * 120, 1e-2f);
  // One ev100 more is one stop darker.
  ASSERT_EQ(run({"render", "--size", "8", "--ev100", "5", "-o", path("a.exr")}).code, 0);
  ASSERT_EQ(run({"render", "--size", "8", "--ev100", "6", "-o", path("b.exr")}).code, 0);
  EXPECT_NEAR(read_exr(path("a.exr")).data.front() / read_exr(path("b.exr")).data.front(), 2, 1e-4);
}

TEST_F(MixRender, DefaultPictureAndReport) {
  const Outcome outcome = run({"render", "b=off", "--size", "16", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["output"], path("wall.png"));
  EXPECT_EQ(report["camera"], "main");
  EXPECT_EQ(report["width"], 16);
  EXPECT_EQ(report["groups"][1]["weight"][0], 0.0);
  EXPECT_NEAR(report["exposure"]["log_mean"].get<double>(), kLuminance * 100, 1e-3);
  const Image picture = read_image(path("wall.png"));
  EXPECT_EQ(picture.width, 16);
}

TEST_F(MixRender, PictureOnStandardOutput) {
  const Outcome outcome = run({"render", "--size", "8", "-o", "-"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out.substr(1, 3), "PNG");
  EXPECT_EQ(files(), 1u);
}

TEST_F(MixRender, PresetsGiveWayToTheCommandLine) {
  write_file(path("mood.toml"), "others = \"off\"\nexposure = \"+2\"\ncamera = \"main\"\n[mix]\na = 0.5\n");
  Outcome outcome = run({"render", "--preset", path("mood.toml"), "--size", "8", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["groups"][0]["weight"][0], 0.5);
  EXPECT_EQ(report["groups"][1]["weight"][0], 0.0);
  EXPECT_EQ(report["exposure"]["mode"], "auto +2");
  outcome = run({"render", "--preset", path("mood.toml"), "a=2", "--others", "on", "--exposure", "auto",
                 "--size", "8", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["groups"][0]["weight"][0], 2.0);
  EXPECT_EQ(report["groups"][1]["weight"][0], 1.0);
  EXPECT_EQ(report["exposure"]["mode"], "auto");
}

TEST_F(MixRender, PictureFromAPointOfOnesOwn) {
  ASSERT_EQ(run({"render", "--eye", "0,0,-2", "--target", "0,0,0", "--size", "8x8", "--tone", "linear", "-o",
                 path("x.exr"), "--coverage", path("c.exr")})
                .code,
            0);
  for (const float v : read_exr(path("x.exr")).data) EXPECT_EQ(v, 0);  // the wall's back
  EXPECT_EQ(read_exr(path("c.exr")).stride(), 1u);
}

// A mirror whose image of a sky of 4 cd/m2 follows the sky's fader.
TEST_F(MixRender, ReflectionsFollowTheFaders) {
  PackageContents c = test_package(1, 1, 8, 8);
  c.scene.materials[0].metallic = 1;
  c.scene.materials[0].roughness = 0;
  add_sky(c.scene, Rgb(4), Id<LightGroup>(0));
  write_package(package(), c);
  const auto seen = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "--size", "5x5", "--device", "cpu", "-o", path("x.exr")});
    EXPECT_EQ(run(more).code, 0);
    return read_exr(path("x.exr")).rgb_at(2, 2).g;
  };
  EXPECT_NEAR(seen({}), 0.5f * 4, 1e-5f);
  EXPECT_NEAR(seen({"a=25%"}), 0.5f, 1e-5f);
  const float matt = seen({"--no-reflections"});
  c.scene.materials[0].metallic = 0;
  c.scene.materials[0].roughness = 1;
  write_package(package(), c);
  EXPECT_EQ(matt, seen({})) << "without reflections a metal is as if matt";
  EXPECT_GT(matt, 0);
}

TEST_F(MixRender, BadRequestsAreOneLineAndLeaveNothing) {
  const std::string out = path("x.png");
  expect_error({"render", "--size", "0x0", "-o", out}, 2, "0x0");
  expect_error({"render", "--camera", "maim", "-o", out}, 2, "did you mean 'main'");
  expect_error({"render", "c=1", "-o", out}, 2, "unknown light group 'c'");
  expect_error({"render", "a=dim", "-o", out}, 2, "'dim'");
  expect_error({"render", "a=2700K,#ff0000", "-o", out}, 2, "two colours");
  expect_error({"render", "--tone", "agxx", "-o", out}, 2, "agx");
  expect_error({"render", "--device", "vulkan", "-o", out}, 2, "auto, cpu, gl, software");
  expect_error({"render", "--exposure", "1", "--ev100", "1", "-o", out}, 2, "exclude");
  expect_error({"render", "--eye", "1,2,3", "-o", out}, 2, "--target");
  expect_error({"render", "-o", path("x.gif")}, 2, ".png");
  expect_error({"render", "-o", path("no/x.png")}, 1, "no/x.png");
  expect_error({"mix", "-o", path("no/x.exr")}, 1, "no/x.exr");
  expect_error({"mix", "-o", path("x.jpg")}, 2, ".exr, .png");
  expect_error({"mix", "-o", path("x.exr"), "--tone", "agx"}, 2, "-o FILE.png");
  expect_error({"mix", "-o", path("x.png"), "--exposure", "bright"}, 2, "'bright'");
  expect_error({"render", "--device", "software", "-o", path("x.exr")}, 2, "-o FILE.png");
  expect_error({"mix"}, 2, "-o");
  EXPECT_EQ(files(), 1u);
}

// A file-size limit stands in for a full disk.
TEST_F(MixRender, FullDiskLeavesNothing) {
  write_package(package(), test_package(2, 2, 128, 128));
  const Outcome full = run_sconce({"mix", package(), "-o", path("x.exr")}, "ulimit -f 2; trap '' XFSZ;");
  EXPECT_EQ(full.code, 1) << full.err;
  EXPECT_NE(full.err.find("x.0.exr: cannot be written"), std::string::npos) << full.err;
  EXPECT_EQ(files(), 1u);
}

TEST_F(MixRender, DamagedPackageIsNamed) {
  std::filesystem::resize_file(path("wall.sconce/layers/b.0.exr"), 100);
  expect_error({"render", "-o", path("x.png")}, 1, "layers/b.0.exr");
  std::filesystem::remove(path("wall.sconce/manifest.json"));
  expect_error({"mix", "-o", path("x.exr")}, 1, "no sconce package");
}

}  // namespace
}  // namespace sconce
