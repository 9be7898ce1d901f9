// SPDX-License-Identifier: Apache-2.0
// The program on a file that may be broken, within limits of time and memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sconce::robustness {

/// Seconds of computing, which other programs on the machine do not change; by the clock, for what waits.
inline constexpr int kSeconds = 10, kAsleep = 100, kGigabytes = 4;

/// The sconce that is tried.
struct Program {
  std::string path;
  bool sanitized = false;  ///< built with the address and undefined-behaviour sanitizers
};
/// @throws Error: no such file
Program program_at(const std::string& path);

enum class End { done, refused, finding };

struct Run {
  End end = End::done;
  std::string line;  ///< what it said of why it refused, or what is wrong
  double seconds = 0;
};

/// `sconce WORDS`. Refused is: exit code 1 or 2 and one line that names `file`. Findings are a signal, any
/// other exit code, more than kSeconds or kGigabytes, a sanitizer's report, a refusal without its line.
Run run_limited(const Program& program, std::vector<std::string> words, const std::filesystem::path& file);

/// Of all runs so far, the most memory that any one took, in MB.
double most_megabytes();

}  // namespace sconce::robustness
