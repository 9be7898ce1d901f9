// SPDX-License-Identifier: Apache-2.0
// `sconce relight` by OpenGL against the CPU's, light shaders against lamps of the same kind, and their
// mistakes.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "gpu/lamp_program.h"
#include "image/io.h"
#include "relit_room.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using namespace test;

class RelightByOpenGl : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string file(const std::string& name) const { return (folder / name).string(); }
  test::Outcome relight(const std::string& name, const Names& lamps,
                        const Names& more = {"--device", "gl"}) const {
    Names words{"relight", room().package, "--others", "off", "--size", "96x64", "-o", file(name), "--quiet"};
    for (const std::string& lamp : lamps) words.insert(words.end(), {"--light", lamp});
    words.insert(words.end(), more.begin(), more.end());
    return test::run_sconce(words);
  }
  Image picture(const Names& lamps, const Names& more = {"--device", "gl"}) const {
    const test::Outcome made = relight("x.exr", lamps, more);
    EXPECT_EQ(made.code, 0) << made.err;
    return made.code == 0 ? read_exr(file("x.exr")) : Image::rgb(96, 64);
  }
};

// Edges of shadows on the coarse cloud are what differs.
TEST_F(RelightByOpenGl, IsTheCpus) {
  const Names lamp{"point,position=-0.3,1.5,0.2,lumens=400"};
  EXPECT_LT(error_of(picture(lamp, {"--device", "cpu"}), picture(lamp)), 0.01);
  const Names pixels{"--camera", "main", "--pixels", "--device"};
  const auto with = [&](const char* device) {
    Names words = pixels;
    words.push_back(device);
    Names all{"relight", room().package, "--others", "off", "-o", file("p.exr"), "--light", lamp[0]};
    all.insert(all.end(), words.begin(), words.end());
    const test::Outcome made = test::run_sconce(all);
    EXPECT_EQ(made.code, 0) << made.err;
    return read_exr(file("p.exr"));
  };
  EXPECT_LT(error_of(with("cpu"), with("gl")), 0.015);
}

TEST_F(RelightByOpenGl, ExamplesAreTheLampsOfTheirNames) {
  const std::string place = ",position=-0.2,1.9,0.3,target=0.3,0.5,-0.4,intensity=100";
  const auto shader = [&](const std::string& name, const std::string& more) {
    return "shader,file=" + example(name) + place + more;
  };
  // Their cubes are turned otherwise, so that texels at edges of shadows are others.
  const auto expect_same = [&](const std::string& lamp, const std::string& own) {
    EXPECT_LT(error_of(picture({lamp}), picture({own})), 5e-3) << own;
  };
  expect_same("point" + place + ",range=3", shader("point.glsl", ",range=3"));
  expect_same("spot" + place + ",inner=10,outer=40", shader("spot.glsl", ",inner=10,outer=40,shadow=80"));
  expect_same("sun,direction=0.3,-0.2,-1,intensity=50",
              "shader,file=" + example("sun.glsl") + ",direction=0.3,-0.2,-1,intensity=50,shadow=sun");
}

// Nothing stands before the back wall: with shadows or without it looks the same, direct light included.
TEST_F(RelightByOpenGl, WithoutShadowsAsWithThem) {
  const std::string lamp = "shader,file=" + example("point.glsl") + ",position=0,1.2,0,intensity=100";
  const auto seen = [&](const std::string& more) {
    return picture({lamp + more},
                   {"--device", "gl", "--eye", "0,1.6,0.9", "--target", "0,1.6,-1", "--fov", "10"});
  };
  EXPECT_LT(error_of(seen(""), seen(",shadow=none")), 0.02);
}

// A slide that is red on the left throws red on the left: the wall behind is (a / pi) I / depth2.
TEST_F(RelightByOpenGl, AProjectorThrowsItsSlide) {
  const Image8 slide{4, 1, 3, {255, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0, 255}};
  write_png(file("slide.png"), slide);
  const std::string lamp =
      "shader,file=" + example("projector.glsl") +
      ",position=0,1.4,0.9,target=0,1.4,-1,intensity=" + "100,fov=30,shadow=60,slide=" + file("slide.png");
  const Image seen =
      picture({lamp}, {"--device", "gl", "--eye", "0,1.4,0.95", "--target", "0,1.4,-1", "--fov", "30"});
  const Rgb left = seen.rgb_at(40, 32), right = seen.rgb_at(56, 32);
  EXPECT_GT(left.r, 5 * left.b);
  EXPECT_GT(right.b, 5 * right.r);
  EXPECT_NEAR(left.r, 0.7f * kInvPi * 100 / (1.9f * 1.9f), 1.0f);
}

// Lux by a shader, direct by its shadow maps and gathered from the lightmap, is that of paths from the same
// lamp: on a table, behind the block, and above the lamp, where all light is reflected. There texels count,
// which are 6 cm wide and dark behind the lamps of the ceiling.
TEST_F(RelightByOpenGl, MetersKnowShaders) {
  const auto lux = [&](const Names& more) {
    Names words{"probe", room().package, "--json", "--samples", "4096", "right=off"};
    words.insert(words.end(), more.begin(), more.end());
    for (const char* at : {"0,0.8,0.3", "0.9,0.2,-0.35", "0.2,1.8,0.1"})
      words.insert(words.end(), {"--at", at});
    words.insert(words.end(), {"-o", file("lux.csv")});
    const test::Outcome probed = test::run_sconce(words);
    EXPECT_EQ(probed.code, 0) << probed.err;
    std::vector<double> out;
    const Names lines = split(read_file(file("lux.csv")), '\n');
    for (std::size_t i = 1; i < 4; ++i) out.push_back(parse_number(split(lines.at(i), ',').at(6)).value());
    return out;
  };
  const auto expect_same = [&](const std::string& option, const std::string& words, const Names& more) {
    const auto of = [&](const std::string& kind) {
      const std::size_t at = words.find("LAMP");
      Names all{option, words.substr(0, at) + kind + words.substr(at + 4)};
      all.insert(all.end(), more.begin(), more.end());
      return lux(all);
    };
    const std::vector<double> shader = of("shader,file=" + example("point.glsl")), rays = of("point");
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_NEAR(shader[i], rays[i], (i < 2 ? 0.02 : 0.04) * rays[i]) << words << i;
  };
  const std::string there = "LAMP,position=-0.3,1.5,0.2,intensity=30";
  expect_same("--light", there, {"left=off"});
  expect_same("--kind", "lamp left=LAMP,intensity=12", {"left=0.5", "--move", "lamp left=-0.3,1.5,0.2"});
  // Inside of the block nothing shines, not even what casts no shadow.
  const test::Outcome inside = test::run_sconce(
      {"probe", room().package, "--json", "--at", "0.35,0.4,-0.35", "--light",
       "shader,file=" + example("point.glsl") + ",position=-0.3,1.5,0.2,intensity=30,shadow=none"});
  ASSERT_EQ(inside.code, 0) << inside.err;
  EXPECT_NE(inside.out.find("\"maximum\": 0.0,"), std::string::npos) << inside.out;
  expect_same("--light", there, {"left=off", "--object", "block=-0.4,0.4,-0.3,30"});
}

TEST_F(RelightByOpenGl, BadInputIsOneLine) {
  write_file(folder / "bad.glsl", "vec3 light(vec3 P, vec3 N) {\n  return vec2(1.0);\n}\n");
  const auto expect = [&](const std::string& lamp, int code, const std::string& text, const Names& more) {
    const test::Outcome outcome = relight("x.exr", {lamp}, more);
    EXPECT_EQ(outcome.code, code) << lamp << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  const Names gl{"--device", "gl"};
  const std::string good = "shader,file=" + example("point.glsl") + ",position=0,1,0";
  expect("shader,file=" + file("bad.glsl") + ",position=0,1,0", 1, "bad.glsl:2: `return vec2(1.0);`: ", gl);
  expect("shader,file=" + file("none.glsl") + ",position=0,1,0", 1, "none.glsl", gl);
  expect("shader,position=0,1,0", 2, "names no file", gl);
  expect(good + ",rang=2", 2, "did you mean 'range'", gl);
  expect(good + ",shadow=round", 2, "none, cube, sun", gl);
  expect(good, 2, "light shaders need OpenGL", {"--device", "cpu"});
  expect(good, 2, "64 to 16384", {"--device", "gl", "--shadow-map", "2"});
  write_file(folder / "nan.glsl", "vec3 light(vec3 P, vec3 N) {\n  return vec3(sqrt(P.x));\n}\n");
  const test::Outcome holed = relight("x.exr", {"shader,file=" + file("nan.glsl") + ",position=0,1,0"}, gl);
  EXPECT_EQ(holed.code, 0) << holed.err;
  EXPECT_NE(holed.err.find("nan.glsl: NaN or infinity, painted over: "), std::string::npos) << holed.err;
  for (const float v : read_exr(file("x.exr")).data) ASSERT_TRUE(std::isfinite(v));
}

/// Error's text of compiling a lamp.
std::string complaint(const std::string& text, const std::vector<gpu::LampUniform>& uniforms = {}) {
  const gpu::Context context;
  try {
    const gpu::LampProgram program("own.glsl", text);
    gpu::LampShader lamp;
    lamp.file = "own.glsl", lamp.uniforms = uniforms;
    const gpu::LampValues values(context, lamp, program);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

TEST(LightShader, MistakesAreShownWithTheUsersLine) {
  const std::string wrong =
      complaint("// one\nuniform float a;\nvec3 light(vec3 P, vec3 N) {\n  return vec3(b);\n}\n");
  EXPECT_TRUE(wrong.starts_with("own.glsl:4: `return vec3(b);`: ")) << wrong;
  EXPECT_EQ(wrong.find('\n'), std::string::npos) << wrong;
  EXPECT_EQ(complaint("vec3 shine(vec3 P) { return P; }"),
            "own.glsl: defines no light (allowed: vec3 light(vec3 P, vec3 N) { ... })");
  const std::string good =
      "uniform float width;\nuniform vec2 size;\nuniform sampler2D slide;\nvec3 light(vec3 P, vec3 N) {\n"
      "  return texture(slide, P.xy * size).rgb * width;\n}\n";
  EXPECT_EQ(complaint(good, {{"width", {2}, "2"}, {"size", {1, 2}, "1,2"}}), "");
  const std::string unknown = complaint(good, {{"widh", {2}, "2"}});
  EXPECT_NE(unknown.find("did you mean 'width'?"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("size"), std::string::npos) << unknown;
  EXPECT_EQ(complaint(good, {{"size", {1}, "1"}}), "own.glsl: size: '1' does not fit (allowed: 2 numbers)");
  const std::string missing = complaint(good, {{"slide", {}, "nowhere.png"}});
  EXPECT_NE(missing.find("nowhere.png"), std::string::npos) << missing;
}

}  // namespace
}  // namespace sconce
