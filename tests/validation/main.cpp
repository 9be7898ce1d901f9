// SPDX-License-Identifier: Apache-2.0
// Writes docs/validation.md: `validation DATA PAGE.md`. Exit code 3 where a row is off.
#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "core/files.h"
#include "rows.h"

int main(int argc, char** argv) {
  using namespace sconce;
  if (argc != 3) {
    fmt::print(stderr, "usage: validation DATA PAGE.md\n");
    return 2;
  }
  try {
    std::vector<validation::Section> made;
    for (const validation::SectionRow& section : validation::sections()) {
      fmt::print(stderr, "{}\n", section.name);
      made.push_back(section.make(argv[1]));
    }
    write_file(argv[2], validation::page(made));
    fmt::print("{}: {} rows are off\n", argv[2], validation::failing(made));
    return validation::failing(made) == 0 ? 0 : 3;
  } catch (const Error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 1;
  }
}
