// SPDX-License-Identifier: Apache-2.0
// For tests: the reference compiler's word on shaders.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/files.h"
#include "core/program.h"
#include "core/test_folder.h"

namespace sconce {

/// @param stage  "frag", "vert"
inline void expect_valid_glsl(const std::set<std::string>& texts, const std::string& stage) {
  constexpr std::size_t kAtOnce = 400;
  const TemporaryFolder folder;
  std::vector<std::string> command{"glslangValidator"};
  std::size_t n = 0;
  for (const std::string& text : texts) {
    command.push_back((folder / (std::to_string(n++) + "." + stage)).string());
    write_file(command.back(), text);
    if (command.size() <= kAtOnce && n < texts.size()) continue;
    const int code = run_program(command, folder / "out", folder / "error", {});
    EXPECT_EQ(code, 0) << read_file(folder / "out").substr(0, 2000) << read_file(folder / "error");
    command.resize(1);
  }
}

}  // namespace sconce
