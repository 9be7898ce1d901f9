// SPDX-License-Identifier: Apache-2.0
// Near-field light fields in OpenEXR.
#include "fuzz.h"
#include "photometry/light_field_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("lamp.exr");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] { read_light_field(path); });
}
