// SPDX-License-Identifier: Apache-2.0
// Small rooms for tests.
#pragma once

#include "scene/shapes.h"

namespace sconce {

/// A white box of 2 m with one red wall; two lamps of different colours under its ceiling.
inline Scene coloured_box() {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f)), Vec3(-1, 0, -1), Vec3(1, 2, 1), true);
  add_quad(scene, "red", add_material(scene, "red", Rgb(0.7f, 0.05f, 0.05f)), Vec3(-0.999f, 0, -1),
           Vec3(0, 2, 0), Vec3(0, 0, 2));
  add_quad(scene, "lamp left", add_material(scene, "glow", Rgb(0), Rgb(30, 25, 20)),
           Vec3(-0.8f, 1.99f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  add_quad(scene, "lamp right", add_material(scene, "glow 2", Rgb(0), Rgb(3, 8, 12)),
           Vec3(0.4f, 1.99f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  return scene;
}

/// Two rooms, x below and above 0, made of double-sided sheets that run through; a wall of `thickness` metres
/// between them, 0 = a sheet; a lamp in the left one.
inline Scene partition(float thickness) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.8f), {}, true);
  add_quad(scene, "floor", white, Vec3(-3, 0, 0), Vec3(0, 0, 2), Vec3(6, 0, 0));
  add_quad(scene, "ceiling", white, Vec3(-3, 2.5f, 0), Vec3(6, 0, 0), Vec3(0, 0, 2));
  add_quad(scene, "back", white, Vec3(-3, 0, 0), Vec3(6, 0, 0), Vec3(0, 2.5f, 0));
  add_quad(scene, "front", white, Vec3(-3, 0, 2), Vec3(0, 2.5f, 0), Vec3(6, 0, 0));
  add_quad(scene, "left", white, Vec3(-3, 0, 0), Vec3(0, 2.5f, 0), Vec3(0, 0, 2));
  add_quad(scene, "right", white, Vec3(3, 0, 0), Vec3(0, 0, 2), Vec3(0, 2.5f, 0));
  if (thickness > 0)
    add_box(scene, "wall", white, Vec3(-thickness / 2, -0.1f, -0.1f), Vec3(thickness / 2, 2.6f, 2.1f), false);
  else
    add_quad(scene, "wall", white, Vec3(0, -0.1f, -0.1f), Vec3(0, 2.7f, 0), Vec3(0, 0, 2.2f));
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(1000)), Vec3(-0.4f, 2.4f, 0.8f),
           Vec3(0.3f, 0, 0), Vec3(0, 0, 0.3f));
  return scene;
}

/// Two rooms of 3 x 3 x 2.5 m on both sides of a wall of 10 cm at x = 0, with a door 0.9 m wide and 2.1 m
/// high in its middle (z = 0); a bulb of 100 cd in the left one at (-1.5, 1.5, 0).
inline Scene two_rooms(bool door_open) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.7f));
  add_box(scene, "rooms", white, Vec3(-3, 0, -1.5f), Vec3(3, 2.5f, 1.5f), true);
  const auto wall = [&](const char* name, const Vec3& lo, const Vec3& hi) {
    add_box(scene, name, white, Vec3(-0.05f, lo.y, lo.z), Vec3(0.05f, hi.y, hi.z), false);
  };
  wall("wall left", Vec3(0, -0.1f, -1.6f), Vec3(0, 2.6f, -0.45f));
  wall("wall right", Vec3(0, -0.1f, 0.45f), Vec3(0, 2.6f, 1.6f));
  wall("lintel", Vec3(0, 2.1f, -0.45f), Vec3(0, 2.6f, 0.45f));
  if (!door_open) wall("door", Vec3(0, -0.05f, -0.5f), Vec3(0, 2.15f, 0.5f));
  Light bulb;
  bulb.name = "bulb";
  bulb.intensity = Rgb(100);
  bulb.frame[3] = glm::vec4(-1.5f, 1.5f, 0, 1);
  scene.lights.push_back(bulb);
  return scene;
}

}  // namespace sconce
