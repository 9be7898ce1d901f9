// SPDX-License-Identifier: Apache-2.0
// make_theatre FILE.glb: writes the playhouse.
#include <cstdio>
#include <exception>

#include "core/files.h"
#include "glb_writer.h"
#include "theatre.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_theatre FILE.glb\n");
    return 2;
  }
  try {
    sconce::write_file(argv[1], sconce::demo::write_glb(sconce::demo::make_theatre()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_theatre: %s\n", error.what());
    return 1;
  }
  return 0;
}
