// SPDX-License-Identifier: Apache-2.0
// A layer file, as KTX2 and as OpenEXR, and what an encoding makes of its texels: which one, its length says.
#include "fuzz.h"
#include "image/ktx2.h"
#include "package/layer_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("layer");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  int width = 32, height = 32;
  std::size_t planes = 1;
  fuzz::answers([&] {
    const Ktx2 texture = read_ktx2(path);
    width = texture.width, height = texture.height, planes = static_cast<std::size_t>(texture.layers);
  });
  const std::span<const Encoding> all = encodings();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Encoding& encoding = all[(size + i) % all.size()];
    if (static_cast<std::size_t>(encoding.planes) != planes) continue;
    return fuzz::answers([&] {
      decode(read_layer_file(path, {&encoding, width, height, {"a.R", "a.G", "a.B"}, {1, 1, 1, 1}}));
    });
  }
  return 0;
}
