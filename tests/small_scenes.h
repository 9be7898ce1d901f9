// SPDX-License-Identifier: Apache-2.0
// Scenes that tests make themselves.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "package/glb.h"
#include "scene/shapes.h"

namespace sconce::test {

/// IES: 300 cd down, 100 cd at 60 degrees, nothing beyond.
inline const char* const kPhotometricLamp =
    "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1 600 1 2 1 1 2 0 0 0\n1 1 10\n0 60\n0\n300 100\n";

/// A 2 m box, one red wall, a block on the floor, two lamps under the ceiling in groups `left` and `right`.
inline Scene two_lamp_room() {
  Scene scene;
  scene.name = "room";
  const auto white = add_material(scene, "white", Rgb(0.7f)),
             red = add_material(scene, "red", Rgb(0.7f, 0.1f, 0.1f));
  add_quad(scene, "floor", white, Vec3(-1, 0, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  add_quad(scene, "ceiling", white, Vec3(-1, 2, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  add_quad(scene, "back", white, Vec3(-1, 0, -1), Vec3(2, 0, 0), Vec3(0, 2, 0));
  add_quad(scene, "front", white, Vec3(-1, 0, 1), Vec3(0, 2, 0), Vec3(2, 0, 0));
  add_quad(scene, "red wall", red, Vec3(-1, 0, -1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  add_quad(scene, "right wall", white, Vec3(1, 0, -1), Vec3(0, 0, 2), Vec3(0, 2, 0));
  add_box(scene, "block", white, Vec3(0.1f, 0, -0.6f), Vec3(0.6f, 0.8f, -0.1f), false);
  const auto warm = add_material(scene, "warm", Rgb(0), Rgb(30, 25, 18)),
             cool = add_material(scene, "cool", Rgb(0), Rgb(5, 9, 14));
  const auto left =
      add_quad(scene, "lamp left", warm, Vec3(-0.8f, 1.98f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  const auto right =
      add_quad(scene, "lamp right", cool, Vec3(0.4f, 1.98f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  scene.instances[left.value].group_name = "left";
  scene.instances[right.value].group_name = "right";
  Camera camera;
  camera.name = "main";
  camera.frame[3] = glm::vec4(0, 1, 0.95f, 1);
  camera.yfov = 1.3f;
  camera.aspect = 1;
  scene.cameras.push_back(camera);
  return scene;
}

inline const Vec3 kBlock{0.35f, 0.4f, -0.35f};  ///< the block's middle

/// The same with its block elsewhere. @param degrees  it is turned, from above
inline Scene with_block_at(const Vec3& middle, float degrees) {
  Scene scene = two_lamp_room();
  for (Instance& instance : scene.instances)
    if (instance.name == "block")
      instance.transform = glm::translate(Mat4(1), middle) *
                           glm::rotate(Mat4(1), glm::radians(degrees), Vec3(0, 1, 0)) *
                           glm::translate(Mat4(1), -kBlock) * instance.transform;
  return scene;
}

/// The same without its ceiling.
inline Scene two_lamp_court() {
  Scene scene = two_lamp_room();
  scene.instances.erase(scene.instances.begin() + 1);
  return scene;
}

}  // namespace sconce::test
