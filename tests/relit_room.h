// SPDX-License-Identifier: Apache-2.0
// A room for tests of moved lamps by OpenGL.
#pragma once

#include "image/image.h"
#include "process.h"
#include "small_scenes.h"

namespace sconce::test {

using Names = std::vector<std::string>;

/// The room without its front wall, for the sun.
inline Scene open_room() {
  Scene scene = two_lamp_room();
  std::erase_if(scene.instances, [](const Instance& i) { return i.name == "front"; });
  return scene;
}

/// One room, baked and with operators once for all tests.
struct Room {
  TemporaryFolder folder;
  std::string package = (folder / "room.sconce").string();

  Room() {
    write_file(folder / "room.glb", write_glb(open_room(), "test"));
    for (const Names& words :
         {Names{"bake", (folder / "room.glb").string(), "--density", "16", "--samples", "64"},
          Names{"transfer", package, "--gather", "1024"},
          Names{"transfer", package, "--gather", "1024", "--camera", "main", "--size", "64x64"}}) {
      const Outcome made = run_sconce(words);
      EXPECT_EQ(made.code, 0) << made.err;
    }
  }
};

inline const Room& room() {
  static const Room one;
  return one;
}

/// A light shader that is shipped.
inline std::string example(const std::string& name) {
  return (std::filesystem::path(SCONCE_SOURCE_DIR) / "examples/lights" / name).string();
}

/// Relative RMSE of 4 x 4 box means, as `sconce diff` has it.
inline double error_of(const Image& a, const Image& b) {
  double squares = 0, sum = 0;
  for (int y = 0; y + 4 <= a.height; y += 4)
    for (int x = 0; x + 4 <= a.width; x += 4) {
      Rgb p, q;
      for (int k = 0; k < 16; ++k) p += a.rgb_at(x + k % 4, y + k / 4), q += b.rgb_at(x + k % 4, y + k / 4);
      squares += std::pow(static_cast<double>(luminance(p) - luminance(q)), 2);
      sum += static_cast<double>(luminance(p));
    }
  const double boxes = static_cast<double>(a.width / 4) * (a.height / 4);
  return std::sqrt(squares / boxes) / (sum / boxes);
}

}  // namespace sconce::test
