// SPDX-License-Identifier: Apache-2.0
#include "bathroom.h"

namespace sconce::demo {

Scene make_bathroom() {
  Stage stage;
  stage.scene.name = "bathroom";
  add_materials(stage);
  add_shell(stage);
  add_joinery(stage);
  add_tub(stage);
  add_vanity(stage);
  add_shower(stage);
  add_textiles(stage);
  add_shelves(stage);
  add_plants(stage);
  add_lamps(stage);
  stage.camera("main", {2.25f, 1.47f, 3.32f}, {1.46f, 1.13f, 0.5f}, 84);
  stage.camera("mirror", {2.28f, 1.50f, 1.60f}, {1.50f, 1.22f, 0.1f}, 62);
  stage.camera("shower", {2.45f, 1.48f, 1.75f}, {2.86f, 1.18f, -0.6f}, 62);
  stage.camera("tub", {2.2f, 1.5f, 2.5f}, {0.5f, 0.75f, 0.9f}, 64);
  return stage.scene;
}

}  // namespace sconce::demo
