// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/error.h"

namespace sconce {

/// Where libraries report to. Passed in, never global; both sinks may be empty and must be thread-safe.
struct Progress {
  std::function<void(std::string_view stage, uint64_t done, uint64_t total)> report;
  std::function<void(const std::string& line)> warning;
  std::stop_token stop;

  void at(std::string_view stage, uint64_t done, uint64_t total) const {
    if (report) report(stage, done, total);
  }
  void warn(const std::string& line) const {
    if (warning) warning(line);
  }
  /// @throws Cancelled when a stop was requested
  void check() const {
    if (stop.stop_requested()) throw Cancelled();
  }
};

}  // namespace sconce
