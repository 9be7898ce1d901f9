// SPDX-License-Identifier: Apache-2.0
// reference_table PACKAGE SCENE-NAME REFERENCE-FOLDER [PICTURE-FOLDER]: the table of a package's errors.
#include <cstdio>

#include "reference.h"

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: reference_table PACKAGE SCENE-NAME REFERENCE-FOLDER [PICTURE-FOLDER]\n");
    return 2;
  }
  try {
    const sconce::Package package = sconce::Package::open(argv[1]);
    fmt::print("{:<18} {:>10} {:>10} {:>10}\n", "group", "mean", "rmse", "ref noise");
    for (const auto& row :
         sconce::test::compare_to_references(package, argv[2], argv[3], 64, argc > 4 ? argv[4] : ""))
      fmt::print("{:<18} {:>+9.2f}% {:>9.2f}% {:>9.2f}%\n", row.group, 100 * (row.mean_ratio - 1),
                 100 * row.rmse, 100 * row.noise);
  } catch (const std::exception& error) {
    fmt::print(stderr, "reference_table: {}\n", error.what());
    return 1;
  }
}
