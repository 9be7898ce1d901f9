// SPDX-License-Identifier: Apache-2.0
// What is left of an MTL for assimp. It is left as it is the second time.
#include "import/mtl_filter.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  const std::string once = filtered_mtl(std::string(fuzz::text(data, size)));
  if (filtered_mtl(once) != once) __builtin_trap();
  return 0;
}
