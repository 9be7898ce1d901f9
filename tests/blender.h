// SPDX-License-Identifier: Apache-2.0
// For tests that need Blender: without it they are skipped, or fail where SCONCE_REQUIRE_DATA=1.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/test_data.h"

namespace sconce::test {

inline std::string blender() {
  const char* given = std::getenv("BLENDER");
  return given != nullptr ? given : "blender";
}

class BlenderTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("BLENDER") != nullptr || std::system("command -v blender >/dev/null") == 0) return;
    if (test_data_required()) FAIL() << "blender is absent";
    GTEST_SKIP() << "blender is absent";
  }
};

}  // namespace sconce::test
