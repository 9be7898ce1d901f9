// SPDX-License-Identifier: Apache-2.0
// For tests only: what needs the distribution's headless browser.
#pragma once

#include "core/test_data.h"
#include "process.h"

/// Leaves the test where no browser can be driven: skipped, or failed when data is required.
#define SCONCE_NEEDS_BROWSER()                                                                      \
  do {                                                                                              \
    if (!sconce::test::can_browse()) {                                                              \
      constexpr const char* kMissing = "node, chromium or web/node_modules ('make web') is absent"; \
      if (sconce::test_data_required()) FAIL() << kMissing;                                         \
      GTEST_SKIP() << kMissing;                                                                     \
    }                                                                                               \
  } while (false)
