// SPDX-License-Identifier: Apache-2.0
// What `export` and `serve` say before there is any page.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "core/files.h"
#include "core/text.h"
#include "image/io.h"
#include "image/metrics.h"
#include "package/test_package.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

void expect_refused(const test::Outcome& outcome, int code, const std::string& word) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

// A program without the page beside it, as a build without npm leaves it.
TEST(Export, SaysThatThePageIsNotBuilt) {
  const TemporaryFolder folder;
  fs::copy_file(SCONCE_PROGRAM, folder / "sconce");
  write_package(folder / "x.sconce", test_package(1, 1, 8, 8));
  const std::string package = (folder / "x.sconce").string(), site = (folder / "site").string();
  const std::string program = (folder / "sconce").string();
  expect_refused(test::run_program(program, {"export", package, "--web", site, "--quiet"}), 1, "make web");
  EXPECT_FALSE(fs::exists(site));
  expect_refused(test::run_program(program, {"serve", package, "--port", "0", "--quiet"}), 1, "make web");
}

TEST(Export, RefusesWhatItDoesNotKnow) {
  expect_refused(test::run_sconce({"export", "x.sconce"}), 2, "--web DIR");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", "d", "--tiers", "best"}), 2, "unfiltered");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", "d", "--encoding", "mp3"}), 2, "exp8");
  expect_refused(test::run_sconce({"serve", "x.sconce", "--port", "70000"}), 2, "65535");
}

// Re-baked, a scene with the mix written into its lamps is the mix.
TEST(Export, SceneIsTheMix) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder / name).string(); };
  const auto run = [](const std::vector<std::string>& args) {
    const auto outcome = test::run_sconce(args);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  const auto bake = [&](const std::string& scene, const std::string& package, const char* seed) {
    run({"bake", scene, "-o", package, "--atlas", "256", "--samples", "32", "--seed", seed, "--quiet"});
  };
  const std::string bathroom = (fs::path(SCONCE_SOURCE_DIR) / "scenes/bathroom.glb").string();
  const std::vector<std::string> mix{"window=0.3", "mirror=2,2700K", "shower=off"};
  const auto with_mix = [&](std::vector<std::string> args) {
    args.insert(args.begin() + 2, mix.begin(), mix.end());
    return args;
  };
  bake(bathroom, path("x.sconce"), "1");
  bake(bathroom, path("other.sconce"), "2");
  run(with_mix({"export", path("x.sconce"), "--scene", path("relit.glb"), "--quiet"}));
  bake(path("relit.glb"), path("relit.sconce"), "1");
  const auto render = [&](std::vector<std::string> args, const std::string& out) {
    args.insert(args.end(),
                {"--camera", "tub", "--device", "cpu", "--size", "320x180", "--tone", "linear", "-o", out});
    run(args);
    return read_image(out);
  };
  const Image mixed = render(with_mix({"render", path("x.sconce")}), path("mixed.exr")),
              again = render({"render", path("relit.sconce")}, path("again.exr")),
              other = render(with_mix({"render", path("other.sconce")}), path("other.exr")),
              before = render({"render", path("x.sconce")}, path("before.exr"));
  EXPECT_NEAR(compare(again, mixed).mean_ratio, 1, 0.005);
  // Noise is what two bakes of one scene differ by.
  const double noise = relative_rmse(other, mixed, nullptr, nullptr).rmse;
  EXPECT_LT(relative_rmse(again, mixed, nullptr, nullptr).rmse, 0.5 * noise);
  EXPECT_GT(relative_rmse(before, mixed, nullptr, nullptr).rmse, 0.2);

  folder.write("own.toml", "# mine\n");
  expect_refused(test::run_sconce({"export", path("x.sconce"), "--scene", path("own.glb")}), 1, "own.toml");
  expect_refused(test::run_sconce({"export", path("x.sconce"), "window=off", "--web", path("d")}), 2,
                 "--scene");
}

// Re-baked, a scene that was written with things elsewhere has the lux of the package with the same options,
// and of a room that was built so: the panel moved and the block turned by their nodes.
TEST(Export, SceneHasThingsWhereTheyAre) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder / name).string(); };
  const Vec3 there = test::kBlock + Vec3(-0.9f, 0, 0.2f);
  Scene built = test::with_block_at(there, 30);
  for (Instance& instance : built.instances)
    if (instance.name == "lamp left") instance.transform[3] += glm::vec4(0.6f, -0.58f, 0.2f, 0);
  write_file(folder / "x.glb", write_glb(test::two_lamp_room(), "test"));
  write_file(folder / "built.glb", write_glb(built, "test"));
  const auto run = [](const std::vector<std::string>& args) {
    const auto outcome = test::run_sconce(args);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  };
  const auto bake = [&](const std::string& name) {
    run({"bake", path(name + ".glb"), "--density", "4", "--samples", "1", "--quiet"});
  };
  const auto lux = [&](const std::string& package, std::vector<std::string> more) {
    more.insert(more.begin(), {"probe", path(package + ".sconce"), "--samples", "8192"});
    for (const char* at : {"0.35,0.01,-0.35", "-0.9,0.3,-0.2,-1,0,0", "0.3,0.8,0.4"})
      more.insert(more.end(), {"--at", at});
    more.insert(more.end(), {"-o", path("lux.csv"), "--quiet"});
    run(more);
    std::vector<double> out;
    const auto lines = split(read_file(path("lux.csv")), '\n');
    for (std::size_t i = 1; i < 4; ++i) out.push_back(parse_number(split(lines.at(i), ',').at(6)).value());
    return out;
  };
  const auto expect_same = [](const std::vector<double>& a, const std::vector<double>& b, const char* what) {
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.01 * b[i]) << what << " " << i;
  };
  const std::vector<std::string> moves{
      "left=1.5", "right=0.5",
      "--move",   "lamp left=0,1.4,0.2",
      "--object", fmt::format("block={},{},{},30", there.x, there.y, there.z)};
  const auto exported = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> args{"export", path("x.sconce"), "--scene", path(name + ".glb")};
    args.insert(args.end(), options.begin(), options.end());
    const auto outcome = run(args);
    bake(name);
    return outcome.err;
  };
  bake("x"), bake("built");
  EXPECT_EQ(exported("moved", moves), "");
  expect_same(lux("moved", {}), lux("built", {"left=1.5", "right=0.5"}), "built");

  // Others: a spot in a panel's stead, which keeps its fader, a panel of light, a lamp more, one that nobody
  // can write.
  const std::vector<std::string> others{"right=0.5",
                                        "--kind",
                                        "lamp right=spot,outer=40,intensity=60",
                                        "--kind",
                                        "lamp left=area,size=0.3,0.6",
                                        "--move",
                                        "lamp left=0,1.4,0.2",
                                        "--light",
                                        "point,position=0.5,1.2,0.5,intensity=5"};
  exported("others", others);
  expect_same(lux("others", {}), lux("x", others), "others");
  EXPECT_NE(exported("shader",
                     {"--kind", "lamp left=shader,file=" +
                                    (fs::path(SCONCE_SOURCE_DIR) / "examples/lights/point.glsl").string()})
                .find("lamp 'lamp left' is left out"),
            std::string::npos);
  expect_same(lux("shader", {}), lux("x", {"left=off"}), "shader");
  expect_refused(
      test::run_sconce({"export", path("x.sconce"), "--move", "lamp left=0,1,0", "--web", path("d")}), 2,
      "--scene");
}

// Folders that hold something else are not replaced.
TEST(Export, LeavesOtherFoldersAlone) {
  const TemporaryFolder folder;
  folder.write("thesis.txt", "mine");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", folder.path().string(), "--quiet"}), 1,
                 "something else");
  EXPECT_EQ(read_file(folder / "thesis.txt"), "mine");
}

}  // namespace
}  // namespace sconce
