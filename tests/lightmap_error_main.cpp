// SPDX-License-Identifier: Apache-2.0
// lightmap_error PACKAGE REFERENCE REFERENCE [DROP]: one line per group, `rmse mean-ratio reference-noise
// texels group`; the references are two bakes that differ in their seed. DROP is a share of texels, 0 to 1.
#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "core/text.h"
#include "lightmap_error.h"

int main(int argc, char** argv) {
  const std::optional<double> drop = argc == 5 ? sconce::parse_number(argv[4]) : 0;
  if (argc < 4 || argc > 5 || !drop || *drop < 0 || *drop >= 1) {
    fmt::print(stderr, "usage: lightmap_error PACKAGE REFERENCE REFERENCE [DROP]\n");
    return 2;
  }
  try {
    using sconce::Package;
    for (const auto& row : sconce::test::lightmap_errors(Package::open(argv[1]), Package::open(argv[2]),
                                                         Package::open(argv[3]), *drop))
      fmt::print("{:.6f} {:.6f} {:.6f} {} {}\n", row.rmse, row.mean_ratio, row.noise, row.texels, row.group);
  } catch (const std::exception& error) {
    fmt::print(stderr, "lightmap_error: {}\n", error.what());
    return 1;
  }
}
