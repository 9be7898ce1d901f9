// SPDX-License-Identifier: Apache-2.0
// MTL. Materials have names, and no two the same.
#include "import/mtl.h"

#include <set>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  std::set<std::string> names;
  for (const PlainMaterial& m : parse_mtl(std::string(fuzz::text(data, size))))
    if (m.name.empty() || !names.insert(m.name).second) __builtin_trap();
  return 0;
}
