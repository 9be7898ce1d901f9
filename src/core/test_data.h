// SPDX-License-Identifier: Apache-2.0
// For tests only: where the shared third-party data lies (SCONCE_TEST_DATA), and what to do where it does
// not.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace sconce {

/// Root of the shared data; may not exist.
inline std::filesystem::path test_data() {
  const char* set = std::getenv("SCONCE_TEST_DATA");
  return set != nullptr && *set != '\0' ? set : SCONCE_TEST_DATA_DEFAULT;
}

/// Must absence of the shared data fail (as in CI) rather than skip?
inline bool test_data_required() {
  const char* set = std::getenv("SCONCE_REQUIRE_DATA");
  return set != nullptr && std::string_view(set) == "1";
}

}  // namespace sconce

/// Leaves the test when `wanted` (below test_data(), or any other) is absent: skipped, or failed when data is
/// required.
#define SCONCE_NEEDS_DATA(wanted)                                                \
  do {                                                                           \
    const std::filesystem::path sconce_needed = (wanted);                        \
    if (!std::filesystem::exists(sconce_needed)) {                               \
      if (sconce::test_data_required()) FAIL() << sconce_needed << " is absent"; \
      GTEST_SKIP() << sconce_needed << " is absent";                             \
    }                                                                            \
  } while (false)
