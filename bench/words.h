// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string_view>

#include "core/error.h"

namespace sconce {

/// What a benchmark was called with: names first, then numbers that may be left out.
class Words {
 public:
  Words(int count, char** words) : count_(count), words_(words) {}
  const char* name(int i) const { return words_[i]; }
  /// @throws UsageError where it is no whole number
  int number(int i, int otherwise) const {
    if (i >= count_) return otherwise;
    const char* end = words_[i] + std::strlen(words_[i]);
    int value = 0;
    const auto [at, error] = std::from_chars(words_[i], end, value);
    if (error != std::errc() || at != end || value < 0)
      throw UsageError("word " + std::to_string(i), std::string("'") + words_[i] + "'", "a whole number");
    return value;
  }

 private:
  int count_;
  char** words_;
};

/// A benchmark's main(). @param names  needed at the least
/// @return exit code: 2 after the usage line, 1 after an error
template <class F>
int run_with_words(int argc, char** argv, int names, const char* usage, const F& f) {
  try {
    if (argc <= names) {
      std::fprintf(stderr, "usage: %s\n", usage);
      return 2;
    }
    f(Words(argc, argv));
    return 0;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s\nusage: %s\n", error.what(), usage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace sconce
