// SPDX-License-Identifier: Apache-2.0
// Ray files of every kind, by content.
#include "photometry/rays.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("lamp.rays");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] {
    FarFieldBins bins(24, 36);
    read_rays(path, [&](std::span<const SourceRay> rays) { bins.add(rays); });
    if (bins.flux() > 0) bins.table();
  });
}
