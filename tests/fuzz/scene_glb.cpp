// SPDX-License-Identifier: Apache-2.0
// scene.glb of a package.
#include "fuzz.h"
#include "package/glb.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  return fuzz::answers([&] { read_glb(fuzz::text(data, size), "scene.glb"); });
}
