// SPDX-License-Identifier: Apache-2.0
// make_scene NAME FILE.glb: writes one of our scenes.
#include <cstdio>
#include <exception>
#include <string_view>

#include "bathroom.h"
#include "core/files.h"
#include "glb_writer.h"
#include "theatre.h"

namespace {

struct Row {
  std::string_view name;
  sconce::Scene (*make)();
};
constexpr Row kScenes[] = {{"bathroom", sconce::demo::make_bathroom},
                           {"theatre", sconce::demo::make_theatre}};

}  // namespace

int main(int argc, char** argv) {
  for (const Row& row : kScenes) {
    if (argc != 3 || row.name != argv[1]) continue;
    try {
      sconce::write_file(argv[2], sconce::demo::write_glb(row.make()));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "make_scene: %s\n", error.what());
      return 1;
    }
    return 0;
  }
  std::fprintf(stderr, "usage: make_scene bathroom|theatre FILE.glb\n");
  return 2;
}
