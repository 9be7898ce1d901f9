// SPDX-License-Identifier: Apache-2.0
// Transfer against the bake: a group's lamps through the operator give what its layer holds (test 34 of
// methods.md).
#include <gtest/gtest.h>

#include "core/hash.h"
#include "core/test_data.h"
#include "image/io.h"
#include "package/glb.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Names = std::vector<std::string>;

class Relight : public testing::Test {
 protected:
  TemporaryFolder folder;
  const std::string package = (folder / "room.sconce").string();

  static test::Outcome run(Names words, const Names& more = {}) {
    words.insert(words.end(), more.begin(), more.end());
    return test::run_sconce(words);
  }
  void expect_done(const test::Outcome& outcome) { ASSERT_EQ(outcome.code, 0) << outcome.err; }
  std::string file(const std::string& name) const { return (folder / name).string(); }
  void make_room() {
    write_file(folder / "room.glb", write_glb(test::two_lamp_room(), "test"));
    expect_done(run({"bake", file("room.glb"), "--density", "16", "--samples", "256"}));
    expect_done(run({"transfer", package, "--gather", "1024"}));
  }
  Names picture(const std::string& verb, const std::string& output, const Names& more) const {
    Names words{verb,       package,  "--eye", "0,1.2,0.9", "--target",
                "0,0.6,-1", "--size", "96x64", "-o",        file(output)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  double mean(const std::string& name) const {
    const Image image = read_exr(file(name));
    double sum = 0;
    for (const float v : image.data) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.data.size());
  }
};

TEST_F(Relight, AGroupByTransferIsItsLayer) {
  make_room();
  expect_done(run(picture("render", "baked.exr", {"left=on", "--others", "off", "--device", "cpu"})));
  expect_done(
      run(picture("relight", "moved.exr", {"left=on", "--others", "off", "--light", "group,name=left"})));
  const test::Outcome same =
      run({"diff", file("moved.exr"), file("baked.exr"), "--metric", "rmse", "--fail-above", "6%"});
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_NEAR(mean("moved.exr") / mean("baked.exr"), 1, 0.02);
}

TEST_F(Relight, NewLampsAddAndScale) {
  make_room();
  const std::string lamp = "point,position=0.2,1.5,0.1,lumens=";
  for (const char* lumens : {"100", "300"})
    expect_done(
        run(picture("relight", std::string(lumens) + ".exr", {"--others", "off", "--light", lamp + lumens})));
  EXPECT_NEAR(mean("300.exr") / mean("100.exr"), 3, 1e-4);
  expect_done(run(
      picture("relight", "both.exr", {"--others", "off", "--light", lamp + "100", "--light", lamp + "300"})));
  EXPECT_NEAR(mean("both.exr") / mean("100.exr"), 4, 1e-3);
}

// A lamp that is moved to where it stands is the lamp by transfer; elsewhere its light is elsewhere.
TEST_F(Relight, ALampLeavesItsLayer) {
  make_room();
  expect_done(run(picture("relight", "group.exr", {"--light", "group,name=left"})));
  expect_done(run(picture("relight", "still.exr", {"--move", "left=-0.6,1.98,0"})));
  expect_done(run(picture("relight", "moved.exr", {"--move", "left=0,1.2,0"})));
  EXPECT_NEAR(mean("still.exr") / mean("group.exr"), 1, 0.005);
  EXPECT_EQ(
      run({"diff", file("moved.exr"), file("group.exr"), "--metric", "rmse", "--fail-above", "20%"}).code, 3);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "nobody=0,1,0"})).code, 2);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "left=0,1"})).code, 2);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "left=0,1,0", "--device", "software"})).code, 2);
  const test::Outcome inside =
      run(picture("relight", "x.exr", {"--light", "point,position=0.4,0.3,-0.3,lumens=10"}));
  EXPECT_NE(inside.err.find("inside something"), std::string::npos) << inside.err;
}

// A cut-off state goes on to the same bytes; one of other options is refused.
TEST_F(Relight, AnInterruptedTransferGoesOn) {
  make_room();
  const fs::path op = fs::path(package) / "operators" / "lightmap.bin", state = fs::path(op) += ".state";
  const std::string whole = read_file(op);
  EXPECT_FALSE(fs::exists(state));
  fs::remove(op);
  fs::create_directory(op);  // so that the end cannot be written: the rows stay in the state
  EXPECT_EQ(run({"transfer", package, "--gather", "1024"}).code, 1);
  ASSERT_TRUE(fs::exists(state));
  fs::remove(op);
  fs::resize_file(state, fs::file_size(state) - 100);
  EXPECT_EQ(run({"transfer", package, "--gather", "1024", "--resume", "--rays", "64"}).code, 1);
  expect_done(run({"transfer", package, "--gather", "1024", "--resume"}));
  EXPECT_EQ(hash_hex(read_file(op).substr(512)), hash_hex(whole.substr(512))) << "all but the head's options";
}

// The example host through the C interface. A bulb in a closed empty box: all its light lands, and a share
// rho / (1 - rho) of it comes back, so that 24 lm on 24 m2 of half-white walls are 1 lux on the mean.
TEST_F(Relight, AnyHostByTheCInterface) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.5f)), Vec3(-1), Vec3(1), true);
  Light bulb;
  bulb.intensity = Rgb(1);
  scene.lights.push_back(bulb);
  write_file(folder / "room.glb", write_glb(scene, "test"));
  expect_done(run({"bake", file("room.glb"), "--density", "16", "--samples", "8"}));
  expect_done(run({"transfer", package, "--gather", "1024"}));
  const std::string op = package + "/operators/lightmap.bin";
  const test::Outcome outcome = test::run_program(INDIRECT, {op, "0.3", "0.2", "-0.4", "1.9098593"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  double lux = 0;
  ASSERT_EQ(std::sscanf(outcome.out.c_str(), "%*d points, %*d receivers, %lf", &lux), 1) << outcome.out;
  EXPECT_NEAR(lux, 1, 0.03);
  const test::Outcome none = test::run_program(INDIRECT, {op + "x", "0", "0", "0", "1"});
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("lightmap.binx"), std::string::npos) << none.err;
}

TEST_F(Relight, MistakesAreNamed) {
  make_room();
  EXPECT_EQ(run(picture("relight", "x.exr", {})).code, 2);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--light", "group,name=nobody"})).code, 2);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--light", "lantern,position=0,0,0"})).code, 2);
  const fs::path op = fs::path(package) / "operators" / "lightmap.bin";
  std::string bytes = read_file(op);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_file(op, bytes);
  const test::Outcome damaged = run(picture("relight", "x.exr", {"--light", "group,name=left"}));
  EXPECT_EQ(damaged.code, 1);
  EXPECT_NE(damaged.err.find("lightmap.bin"), std::string::npos) << damaged.err;
  fs::remove(op);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--light", "group,name=left"})).code, 1);
}

/// The same on a scene of others; figures in docs/operator-format.md.
TEST_F(Relight, CornellTwoLights) {
  const fs::path scene = test_data() / "glb" / "cornell-two-lights.glb";
  SCONCE_NEEDS_DATA(scene);
  expect_done(run({"bake", scene.string(), "--atlas", "128", "--samples", "64", "-o", package}));
  expect_done(run({"transfer", package, "--gather", "4096"}));
  const Names small{"--size", "128", "--others", "off", "left=on"};
  expect_done(run({"render", package, "-o", file("baked.exr"), "--device", "cpu"}, small));
  expect_done(run({"relight", package, "-o", file("moved.exr"), "--light", "group,name=left"}, small));
  const test::Outcome same =
      run({"diff", file("moved.exr"), file("baked.exr"), "--metric", "rmse", "--fail-above", "6%"});
  EXPECT_EQ(same.code, 0) << same.out;
}

}  // namespace
}  // namespace sconce
