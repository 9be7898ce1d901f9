// SPDX-License-Identifier: Apache-2.0
// For tests only: the window, driven by scripts on a display of its own.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/files.h"
#include "image/io.h"
#include "package/test_package.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce {

class ViewTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void bake() {
    const auto outcome =
        test::run_sconce({"bake", (std::filesystem::path(SCONCE_SOURCE_DIR) / "scenes/bathroom.glb").string(),
                          "-o", path("x.sconce"), "--atlas", "256", "--samples", "8", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  /// Two lamps and an operator.
  void bake_movable(const Scene& scene = test::two_lamp_room(), const std::vector<std::string>& more = {}) {
    folder_.write("x.glb", write_glb(scene, "test"));
    std::vector<std::string> bake{"bake", path("x.glb"), "--density", "24", "--samples", "128", "--quiet"};
    bake.insert(bake.end(), more.begin(), more.end());
    for (const std::vector<std::string>& words :
         {bake, {"transfer", path("x.sconce"), "--gather", "1024", "--quiet"}}) {
      const auto made = test::run_sconce(words);
      ASSERT_EQ(made.code, 0) << made.err;
    }
  }
  /// Does the work as soon as the window has written that picture.
  std::thread after(const std::string& picture, const std::function<void()>& work) const {
    return std::thread([this, picture, work] {
      for (int i = 0; i < 3000 && !std::filesystem::exists(path(picture)); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      work();
    });
  }
  test::Outcome view(const std::string& script, const std::string& input = "x.sconce",
                     const std::vector<std::string>& options = {}) {
    folder_.write("script.txt", script);
    std::vector<std::string> arguments{"view",   path(input), "--script", path("script.txt"),
                                       "--size", "900x560"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return test::run_sconce(arguments, test::with_display("900x560", 100));
  }
  Image8 png(const std::string& name) const {
    const std::string bytes = read_file(path(name));
    return decode_image8({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, name, 3);
  }
  static double mean_difference(const Image8& a, const Image8& b) {
    EXPECT_EQ(a.data.size(), b.data.size());
    double sum = 0;
    for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
      sum += std::abs(int{a.data[i]} - int{b.data[i]});
    return sum / static_cast<double>(a.data.size());
  }
  TemporaryFolder folder_;
};

}  // namespace sconce
