// SPDX-License-Identifier: Apache-2.0
// The structure of an L3D luminaire.
#include "fuzz.h"
#include "import/l3d_structure.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  return fuzz::answers([&] { parse_l3d(fuzz::text(data, size), "structure.xml"); });
}
