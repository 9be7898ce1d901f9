// SPDX-License-Identifier: Apache-2.0
// Another program, run to its end.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"

namespace sconce {

/// A command line as words. The path of an existing file is one word. Otherwise words end at blanks;
/// '...' and "..." keep them, a backslash keeps the next character (but not inside '...'); no other shell
/// syntax.
/// @throws UsageError: no word, a quote without its end
std::vector<std::string> command_words(const std::string& command);

/// Runs words[0] (looked up in PATH) with the other words as arguments, nothing on standard input, its output
/// in two files. It is the head of a process group of its own, which ends when a stop is requested.
/// @return its exit code, or 128 + the signal that ended it
/// @throws Error: cannot be started; Cancelled
int run_program(std::span<const std::string> words, const std::filesystem::path& standard_output,
                const std::filesystem::path& standard_error, const Progress& progress);

}  // namespace sconce
