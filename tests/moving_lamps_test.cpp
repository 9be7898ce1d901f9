// SPDX-License-Identifier: Apache-2.0
// Transfer against the bake: a group's lamps through the operator give what its layer holds (test 34 of
// methods.md).
#include <gtest/gtest.h>

#include "core/hash.h"
#include "core/test_data.h"
#include "relight_run.h"
#include "scene/lens.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

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

// 5 and 34: two groups together are their sum, to float rounding. And each is its layer as far as both are
// free of noise: the bake keeps light finer (on cells, and by paths where things are close), the file has
// codes of 8 bits. To 1e-5 the two are one where cloud, rays and coefficients are the same: ExactOperator, in
// exact_test.
TEST_F(Relight, SuperpositionOfGroups) {
  write_file(folder / "room.glb", write_glb(test::two_lamp_room(), "test"));
  expect_done(run({"bake", file("room.glb"), "--density", "16", "--samples", "1024"}));
  expect_done(run({"transfer", package, "--gather", "4096", "--rays", "1024", "--cluster", "64"}));
  const auto relit = [&](const std::string& output, const Names& groups) {
    Names words = picture("relight", output, {"--others", "off", "--device", "cpu"});
    for (const std::string& group : groups) {
      words.push_back(group + "=on");
      words.push_back("--light");
      words.push_back("group,name=" + group);
    }
    expect_done(run(words));
    return read_exr(file(output));
  };
  const Image left = relit("left.exr", {"left"}), right = relit("right.exr", {"right"}),
              both = relit("both.exr", {"left", "right"});
  for (std::size_t i = 0; i < both.data.size(); ++i)
    ASSERT_NEAR(both.data[i], left.data[i] + right.data[i], 1e-5f * both.data[i]) << i;
  for (const std::string group : {"left", "right"}) {
    const std::string baked = "baked " + group + ".exr";
    expect_done(run(picture("render", baked, {group + "=on", "--others", "off", "--device", "cpu"})));
    const test::Outcome same =
        run({"diff", file(group + ".exr"), file(baked), "--metric", "rmse", "--fail-above", "1.5%"});
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_NEAR(mean(group + ".exr") / mean(baked), 1, 0.01);
  }
}

// The same file and program with the chapter's own operator, whose bounces are blurred photons.
TEST_F(Relight, AGroupByTheChaptersMethod) {
  make_room();
  expect_done(run({"transfer", package, "--gather", "1024", "--method", "chapter", "--photons", "200000"}));
  expect_done(run(picture("render", "baked.exr", {"left=on", "--others", "off", "--device", "cpu"})));
  expect_done(run(picture("relight", "moved.exr",
                          {"left=on", "--others", "off", "--light", "group,name=left", "--device", "cpu"})));
  const test::Outcome same =
      run({"diff", file("moved.exr"), file("baked.exr"), "--metric", "rmse", "--fail-above", "15%"});
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_NEAR(mean("moved.exr") / mean("baked.exr"), 1, 0.08);
  EXPECT_EQ(run({"transfer", package, "--method", "magic"}).code, 2);
  EXPECT_EQ(run({"transfer", package, "--method", "chapter", "--choice", "best"}).code, 2);
}

// Culling changes a picture by less than it says, and nothing where it is 0.
TEST_F(Relight, CullingTellsItsBound) {
  make_room();
  const Names lamp{"--others", "off", "--light", "spot,position=0.2,1.5,0.1,target=0,0,0,lumens=100",
                   "--device", "cpu"};
  const auto relit = [&](const std::string& output, const Names& more) {
    Names words = picture("relight", output, lamp);
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = run(words);
    expect_done(outcome);
    return outcome.out;
  };
  relit("all.exr", {});
  relit("none.exr", {"--cull", "0"});
  EXPECT_EQ(read_file(file("none.exr")), read_file(file("all.exr")));
  const std::string said = relit("some.exr", {"--cull", "0.002"});
  std::size_t culled = 0, of = 0;
  double bound = 0;
  const std::size_t at = said.find("culled: ");
  ASSERT_NE(at, std::string::npos) << said;
  ASSERT_EQ(std::sscanf(said.c_str() + at, "culled: %zu of %zu coefficients; indirect light is wrong by %lf",
                        &culled, &of, &bound),
            3)
      << said;
  EXPECT_GT(culled, of / 10);
  EXPECT_LE(culled, of);
  EXPECT_EQ(run({"diff", file("some.exr"), file("all.exr"), "--metric", "rmse", "--fail-above",
                 std::to_string(bound) + "%"})
                .code,
            0)
      << said;
  EXPECT_EQ(run(picture("relight", "x.exr", {"--cull", "2", "--light", "group,name=left"})).code, 2);
  EXPECT_EQ(
      run(picture("relight", "x.exr", {"--cull", "0.1", "--light", "group,name=left", "--device", "gl"}))
          .code,
      2);
}

// A camera's pixels: direct light at 2 x 2 points of each, indirect light once a pixel, from the nearest in
// place and normal, mean over the four (the chapter, 9.8.1). The same light as by the lightmap, where each is
// looked up.
TEST_F(Relight, PixelsAreLitFinerThanTheyGather) {
  make_room();
  expect_done(run(
      {"transfer", package, "--camera", "main", "--size", "64x64", "--gather", "1024", "--cluster", "64"}));
  const auto relit = [&](const std::string& output, const Names& more) {
    expect_done(run({"relight", package, "--camera", "main", "left=on", "--others", "off", "--light",
                     "group,name=left", "--samples", "4", "--device", "cpu", "-o", file(output)},
                    more));
  };
  relit("pixels.exr", {"--pixels"});
  relit("texels.exr", {"--size", "64x64"});
  const test::Outcome same =
      run({"diff", file("pixels.exr"), file("texels.exr"), "--metric", "rmse", "--fail-above", "4%"});
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_NEAR(mean("pixels.exr") / mean("texels.exr"), 1, 0.02);
}

// With layers that know directions normal maps turn what a lamp throws (closed form: Picture), and without
// them they are not seen. The floor's normals lean to +x: a lamp on that side lights it more, one on the
// other less.
TEST_F(Relight, NormalMapsTurnDirectLight) {
  Scene scene = test::two_lamp_room();
  Texture map;
  map.pixels = {1, 1, 3, {204, 128, 230}};
  scene.textures = {map};
  Material tiles = scene.materials[0];
  tiles.name = "tiles", tiles.normal_texture.texture = Id<Texture>(0);
  scene.meshes[0].material = Id<Material>(scene.materials.size());
  scene.meshes[0].texcoords = {{Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)}};
  scene.materials.push_back(tiles);
  write_file(folder / "room.glb", write_glb(scene, "test"));
  const auto lit_from = [&](const std::string& x) {
    const std::string out = "from " + x + ".exr";
    expect_done(run({"relight", package, "--eye", "0,0.6,0.4", "--target", "0,0,0.39", "--size", "16x16",
                     "--others", "off", "--light", "point,position=" + x + ",0.5,0.4,lumens=100", "--device",
                     "cpu", "-o", file(out)}));
    return mean(out);
  };
  std::vector<double> ratios;
  for (const std::string basis : {"flat", "sh1"}) {
    expect_done(run({"bake", file("room.glb"), "--density", "16", "--samples", "16", "--basis", basis}));
    expect_done(run({"transfer", package, "--gather", "1024", "--rays", "64"}));
    ratios.push_back(lit_from("0.5") / lit_from("-0.5"));
  }
  EXPECT_NEAR(ratios[0], 1, 0.15);
  EXPECT_GT(ratios[1], 1.5 * ratios[0]);
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
  const test::Outcome unknown = run(picture("relight", "x.exr", {"--move", "lift=0,1,0"}));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'left'"), std::string::npos) << unknown.err;
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "left=0,1"})).code, 2);
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "left=0,1,0", "--device", "software"})).code, 2);
  const test::Outcome inside =
      run(picture("relight", "x.exr", {"--light", "point,position=0.4,0.3,-0.3,lumens=10"}));
  EXPECT_NE(inside.err.find("inside something"), std::string::npos) << inside.err;
}

/// The room with a bulb and a spot that share a group.
Scene room_with_bulbs(const Vec3& bulb_at, const Vec3& spot_at, const Vec3& spot_axis) {
  Scene scene = test::two_lamp_room();
  Light bulb;
  bulb.name = "bulb", bulb.group_name = "bulbs";
  bulb.intensity = Rgb(8, 7, 5);
  bulb.frame[3] = glm::vec4(bulb_at, 1);
  Light spot = bulb;
  spot.name = "spot";
  spot.intensity = Rgb(20);
  spot.shape = SpotLight{.inner = 0.3f, .outer = 0.6f};
  spot.frame = look_at(spot_at, spot_at + spot_axis).frame;
  scene.lights = {bulb, spot};
  return scene;
}

// One lamp of two leaves their layer, which keeps the other: where it stood, the picture is that of the
// layer; elsewhere, that of a bake with the lamp there.
TEST_F(Relight, OneLampLeavesALayerThatStays) {
  const Vec3 before(-0.3f, 1.2f, 0.1f), after(0.5f, 1.5f, 0.4f), spot(-0.7f, 1.7f, 0.6f), down(0, -1, 0),
      aside(0.6f, -0.7f, -0.5f);
  const auto bake = [&](const std::string& name, const Scene& scene, const Names& more) {
    write_file(folder / (name + ".glb"), write_glb(scene, "test"));
    expect_done(run({"bake", file(name + ".glb"), "--density", "16", "--samples", "256"}, more));
  };
  bake("room", room_with_bulbs(before, spot, down), {"--movable"});
  bake("there", room_with_bulbs(after, spot, aside), {});
  expect_done(run(picture("render", "baked.exr", {"--device", "cpu"})));
  expect_done(run(picture("relight", "still.exr", {"--move", "bulb=-0.3,1.2,0.1"})));
  EXPECT_NEAR(mean("still.exr") / mean("baked.exr"), 1, 0.005);
  const auto alike = [&](const std::string& a, const std::string& b, const std::string& most) {
    const test::Outcome outcome = run({"diff", file(a), file(b), "--metric", "rmse", "--fail-above", most});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
  };
  alike("still.exr", "baked.exr", "3%");

  Names elsewhere = picture("render", "there.exr", {"--device", "cpu"});
  elsewhere[1] = file("there.sconce");
  expect_done(run(elsewhere));
  const std::string turned = "spot=-0.7,1.7,0.6,target=-0.1,1,0.1";
  expect_done(run(picture("relight", "moved.exr", {"--move", "bulb=0.5,1.5,0.4", "--move", turned})));
  EXPECT_NEAR(mean("moved.exr") / mean("there.exr"), 1, 0.03);
  alike("moved.exr", "there.exr", "6%");
  // Exposure is metered as `render` does, on the lightmap.
  expect_done(run(picture("render", "baked.png", {"--device", "cpu"})));
  expect_done(run(picture("relight", "still.png", {"--move", "bulb=-0.3,1.2,0.1"})));
  alike("still.png", "baked.png", "3%");
  EXPECT_EQ(run(picture("relight", "x.exr", {"--move", "bulb=0,1,0,target=0,0,0"})).code, 2);
}

// A bake that is repeated leaves an operator that still fits alone, and makes another where it does not.
TEST_F(Relight, BakingAgainKeepsWhatFits) {
  make_room();
  const std::string op = package + "/operators/lightmap.bin", before = read_file(op);
  const Names bake{"bake", file("room.glb"), "--density", "16", "--movable", "--samples"};
  expect_done(run(bake, {"8"}));
  EXPECT_EQ(hash_hex(read_file(op)), hash_hex(before));
  fs::remove(op);
  expect_done(run(bake, {"8"}));
  EXPECT_TRUE(fs::exists(op)) << "where the package is up to date, too";
  EXPECT_EQ(run(bake, {"8", "--shard", "0/2"}).code, 2);
  expect_done(run({"bake", file("room.glb"), "--density", "20", "--samples", "8"}));
  EXPECT_FALSE(fs::exists(op));
  const test::Outcome none = run(picture("relight", "x.exr", {"--move", "left=0,1,0"}));
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("bake --movable"), std::string::npos) << none.err;
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
  expect_done(run({"transfer", package, "--gather", "1024", "--resume", "--threads", "1", "--quiet"}));
  EXPECT_EQ(hash_hex(read_file(op)), hash_hex(whole));
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

// Each in one line that names the file and what is wrong with it.
TEST_F(Relight, OperatorsThatDoNotFitAreNamed) {
  make_room();
  const fs::path op = fs::path(package) / "operators" / "lightmap.bin";
  const std::string good = read_file(op);
  const auto said = [&](const std::string& bytes) {
    write_file(op, bytes);
    const test::Outcome outcome = run(picture("relight", "x.exr", {"--light", "group,name=left"}));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("lightmap.bin"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(file("x.exr")));
    return outcome.err;
  };
  std::string version = good;
  version[12] = 9;
  EXPECT_NE(said(version).find("version 9; this program reads version 1"), std::string::npos);
  EXPECT_NE(said(good.substr(0, good.size() / 2)).find("is damaged: it has"), std::string::npos);
  EXPECT_NE(said(good.substr(0, 100)).find("is no operator"), std::string::npos);
  Scene other = test::two_lamp_room();
  other.materials[0].base_color = Rgb(0.3f);
  write_file(folder / "other.glb", write_glb(other, "test"));
  expect_done(run({"bake", file("other.glb"), "--density", "16", "--samples", "8"}));
  expect_done(run({"transfer", file("other.sconce"), "--gather", "256"}));
  EXPECT_NE(said(read_file(folder / "other.sconce" / "operators" / "lightmap.bin"))
                .find("belongs to another state of this package"),
            std::string::npos);
  const test::Outcome gather = run({"transfer", package, "--gather", "1000"});
  EXPECT_EQ(gather.code, 2);
  EXPECT_NE(gather.err.find("a power of four: 256, 1024"), std::string::npos) << gather.err;
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
