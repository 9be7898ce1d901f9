// SPDX-License-Identifier: Apache-2.0
// For tests only: a room with an operator, and its pictures by `sconce relight`.
#pragma once

#include <gtest/gtest.h>

#include "image/io.h"
#include "package/glb.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {

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
  void make_room(const Scene& scene = test::two_lamp_room()) {
    write_file(folder / "room.glb", write_glb(scene, "test"));
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

}  // namespace sconce
