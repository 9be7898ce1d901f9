// SPDX-License-Identifier: Apache-2.0
// make_near_scenes FOLDER: writes the lamps for the virtual bench and the rooms that they light, as .glb.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/files.h"
#include "glb_writer.h"
#include "luminaires.h"
#include "vaults.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_near_scenes FOLDER\n");
    return 2;
  }
  try {
    using namespace sconce::demo;
    for (const sconce::Scene& scene :
         {make_torch(), make_bicycle_light(), make_louvre(), make_washer(), make_crypt(), make_cloister()})
      sconce::write_file(std::filesystem::path(argv[1]) / (scene.name + ".glb"), write_glb(scene));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_near_scenes: %s\n", error.what());
    return 1;
  }
  return 0;
}
