// SPDX-License-Identifier: Apache-2.0
// GLDF containers.
#include "fuzz.h"
#include "photometry/formats.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("lamp.gldf");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] { read_gldf(path); });
}
