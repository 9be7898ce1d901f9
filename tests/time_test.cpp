// SPDX-License-Identifier: Apache-2.0
// `bake --time`: as many samples as fit, and then the bake with that many.
#include <gtest/gtest.h>

#include "package/package.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {
namespace {

TEST(Time, BecomesSamples) {
  TemporaryFolder folder;
  const std::string scene = folder.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  const auto bake = [&](const char* name, const std::string& option, const std::string& value) {
    const test::Outcome outcome = test::run_sconce(
        {"bake", scene, "--density", "8", "--solver", "path", option, value, "-o", (folder / name).string()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Package::open(folder / name).manifest().facts.at("samples");
  };
  const std::string samples = bake("a.sconce", "--time", "1s");
  EXPECT_GE(std::stoi(samples), 8);
  bake("b.sconce", "--samples", samples);
  EXPECT_TRUE(read_file(folder / "a.sconce/layers/left.0.exr") ==
              read_file(folder / "b.sconce/layers/left.0.exr"));
  EXPECT_EQ(test::run_sconce({"bake", scene, "--time", "1s", "--samples", "8"}).code, 2);
  EXPECT_EQ(test::run_sconce({"bake", scene, "--time", "1s", "--shard", "0/2"}).code, 2);
}

}  // namespace
}  // namespace sconce
