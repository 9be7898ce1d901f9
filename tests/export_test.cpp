// SPDX-License-Identifier: Apache-2.0
// What `export` and `serve` say before there is any page.
#include <gtest/gtest.h>

#include <algorithm>

#include "image/io.h"
#include "image/metrics.h"
#include "package/test_package.h"
#include "process.h"

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
