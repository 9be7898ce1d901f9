// SPDX-License-Identifier: Apache-2.0
// make_bathroom FILE.glb: writes the demo scene.
#include <cstdio>
#include <exception>

#include "bathroom.h"
#include "core/files.h"
#include "glb_writer.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_bathroom FILE.glb\n");
    return 2;
  }
  try {
    sconce::write_file(argv[1], sconce::demo::write_glb(sconce::demo::make_bathroom()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_bathroom: %s\n", error.what());
    return 1;
  }
  return 0;
}
