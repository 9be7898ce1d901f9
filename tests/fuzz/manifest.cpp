// SPDX-License-Identifier: Apache-2.0
// manifest.json of a package. What is taken is written, and read back the same.
#include "package/manifest.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  return fuzz::answers([&] {
    const std::string once = print_manifest(parse_manifest(fuzz::text(data, size), "manifest.json"));
    if (print_manifest(parse_manifest(once, "again")) != once) __builtin_trap();
  });
}
