// SPDX-License-Identifier: Apache-2.0
#include "bathroom.h"
#include "textures.h"

namespace sconce::demo {

void add_materials(Stage& stage) {
  stage.paint("plaster", "ebe6dd");
  stage.paint("ceiling paint", "edeae4");
  stage.paint("joinery", "e9e5dc");
  stage.paint("stone", "e6e1d6");
  stage.paint("enamel", "ece9e3");
  stage.paint("ceramic", "edebe5");
  stage.paint("brass", "ab8a55");
  stage.paint("black steel", "2f3130");
  stage.paint("amber glass", "8a4b1e");
  stage.paint("clay", "b4694a");
  stage.paint("linen", "ddd3c0");
  stage.paint("soap", "e8d9bd");
  stage.paint("sage bottle", "7c9482");
  stage.paint("soil", "3f3026");
  stage.paint("basket", "b8925f");
  stage.paint("stem", "6d7a3c");
  stage.paint("leaf", "4f7a3f", true);
  stage.paint("young leaf", "7fa052", true);
  stage.texture("terrazzo", terrazzo(), {1.2f, 1.2f});
  stage.texture("wall tile", wall_tiles(), {0.6f, 0.8f});
  stage.texture("shower floor tile", floor_mosaic(), {0.6f, 0.6f});
  stage.texture("oak", oak(), {0.8f, 0.8f});
  stage.texture("rug", rug(), {1.1f, 0.7f});
  stage.texture("terracotta towel", terry("b8502f", "efe3d0"), {1, 1}, true);
  stage.texture("teal towel", terry("0f8284", "e3ece6"), {1, 1}, true);
  stage.texture("mirror", mirror_sheen(), {0.6f, 0.96f});
}

}  // namespace sconce::demo
