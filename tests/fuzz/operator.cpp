// SPDX-License-Identifier: Apache-2.0
// An operator file, its checksum left alone, and light sent through what it holds.
#include "transfer/operator.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("operator.bin");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] {
    Operator op = open_operator(path, false);
    op.sweeps = std::min(op.sweeps, 2u);  // any number is allowed, and takes its time
    std::vector<Rgbx> exitance(op.slots(), Rgbx{1, 2, 3, 0});
    indirect_light(op, exitance);
  });
}
