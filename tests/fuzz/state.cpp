// SPDX-License-Identifier: Apache-2.0
// The state of an interrupted bake: checkpoints and shards.
#include "solve/state.h"

#include <algorithm>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("bake.state");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] {
    const BakeState state = BakeState::open(path, true);
    const std::size_t some = std::min<std::size_t>(state.tiles(), 4096);  // a header may promise any number
    for (std::size_t tile = 0; tile < some; ++tile)
      if (state.has(tile))
        for (uint32_t layer = 0; layer < state.header().layers; ++layer) state.read(tile, layer);
  });
}
