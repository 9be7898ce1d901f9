// SPDX-License-Identifier: Apache-2.0
#include "theatre.h"

#include "textures.h"

namespace sconce::demo {

void add_theatre_materials(Stage& stage) {
  stage.paint("wall paint", "b9a78c");
  stage.paint("panel", "5b2a28");
  stage.paint("ceiling", "cbbda3");
  stage.paint("gilding", "b08a45");
  stage.paint("carpet", "5a1f22");
  stage.paint("velvet", "8c1c26");
  stage.paint("seat wood", "4a2c1c");
  stage.paint("black", "26262a");
  stage.paint("iron", "39383a");
  stage.paint("sky cloth", "e4e3de");
  stage.paint("hills", "4d5f6b");
  stage.paint("near hills", "35463f");
  stage.paint("wallpaper", "93a58c");
  stage.paint("woodwork", "dcd3c1");
  stage.paint("armchair", "b5622f");
  stage.paint("book", "7d2f37");
  stage.paint("clay", "b4694a");
  stage.paint("leaf", "56803f", true);
  stage.paint("curtain velvet", "93151f", true);
  stage.paint("gold fringe", "c9a14e");
  stage.paint("masking", "232327", true);
  stage.texture("boards", oak(), {0.9f, 0.9f});
  stage.texture("rug", rug(), {2.4f, 1.6f});
}

Scene make_theatre() {
  Stage stage;
  stage.scene.name = "theatre";
  add_theatre_materials(stage);
  add_house(stage);
  add_seats(stage);
  add_stage_house(stage);
  add_drapes(stage);
  add_set(stage);
  add_theatre_lamps(stage);
  stage.camera("main", {0.9f, 3.5f, 10.6f}, {-0.1f, 3.05f, 0}, 73);
  stage.camera("stage", {0.6f, 2.5f, 4.6f}, {0, 2.55f, -3}, 76);
  stage.camera("from the stage", {-1.9f, 2.6f, -3.2f}, {0.9f, 2.5f, 6}, 82);
  stage.camera("box", {5.6f, 3.4f, 5.2f}, {-1.5f, 2.2f, -1.2f}, 74);
  return stage.scene;
}

}  // namespace sconce::demo
