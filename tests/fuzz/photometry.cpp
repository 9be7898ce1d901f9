// SPDX-License-Identifier: Apache-2.0
// IES LM-63, EULUMDAT and TM-33, by content; what is taken is written as the first two.
#include "fuzz.h"
#include "photometry/formats.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  return fuzz::answers([&] {
    const Photometry lamp = parse_photometry(fuzz::text(data, size), "lamp");
    parse_photometry(write_ies(lamp), "written.ies");
    parse_photometry(write_ldt(lamp), "written.ldt");
  });
}
