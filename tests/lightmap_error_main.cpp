// SPDX-License-Identifier: Apache-2.0
// lightmap_error PACKAGE REFERENCE REFERENCE: one line per group, `rmse mean-ratio reference-noise texels
// group`; the references are two bakes that differ in their seed.
#include <fmt/format.h>

#include <cstdio>

#include "lightmap_error.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: lightmap_error PACKAGE REFERENCE REFERENCE\n");
    return 2;
  }
  try {
    using sconce::Package;
    for (const auto& row : sconce::test::lightmap_errors(Package::open(argv[1]), Package::open(argv[2]),
                                                         Package::open(argv[3])))
      fmt::print("{:.6f} {:.6f} {:.6f} {} {}\n", row.rmse, row.mean_ratio, row.noise, row.texels, row.group);
  } catch (const std::exception& error) {
    fmt::print(stderr, "lightmap_error: {}\n", error.what());
    return 1;
  }
}
