// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>

#include "import/side_parts.h"
#include "init.h"
#include "scene/shapes.h"

namespace sconce::app {

Scene make_room(const RoomRequest& room) {
  const Vec3 lo(-room.size.x / 2, 0, -room.size.z / 2), hi(room.size.x / 2, room.size.y, room.size.z / 2);
  const Vec3 x(room.size.x, 0, 0), y(0, room.size.y, 0), z(0, 0, room.size.z);
  Scene scene;
  scene.name = "room";
  const auto ceiling = add_material(scene, "ceiling", Rgb(room.ceiling));
  const auto walls = add_material(scene, "walls", Rgb(room.walls));
  const auto floor = add_material(scene, "floor", Rgb(room.floor));
  add_quad(scene, "floor", floor, lo, z, x);
  add_quad(scene, "ceiling", ceiling, lo + y, x, z);
  add_quad(scene, "wall north", walls, lo, x, y);
  add_quad(scene, "wall south", walls, lo + z, y, x);
  add_quad(scene, "wall west", walls, lo, y, z);
  add_quad(scene, "wall east", walls, lo + x, z, y);
  Camera camera;
  camera.name = "corner";
  const Vec3 eye(hi.x - 0.3f, std::min(1.6f, 0.6f * hi.y), hi.z - 0.3f);
  camera.frame = looking(eye, Vec3(lo.x, 0.8f, lo.z) - eye);
  camera.yfov = 1.1f;
  scene.cameras.push_back(camera);
  return scene;
}

std::string room_side_file(const RoomRequest& room, const std::string& name) {
  std::string text = fmt::format(
      "# {}: a room of {:.4g} x {:.4g} x {:.4g} m (width, depth, height); reflectances "
      "{:.0f}/{:.0f}/{:.0f}.\n\n",
      name, room.size.x, room.size.z, room.size.y, 100 * room.ceiling, 100 * room.walls, 100 * room.floor);
  if (!room.luminaire.empty())
    text += fmt::format(
        "[[luminaire]]\nfile = \"{}\"\ngroup = \"luminaires\"\nat = [0, {:.4g}, 0]        # the middle of "
        "the grid, metres\n"
        "count = [{}, {}]         # along x, along z\npitch = [{:.6g}, {:.6g}]\n# dim = 0.8\n",
        std::filesystem::path(room.luminaire).filename().string(), room.mount > 0 ? room.mount : room.size.y,
        room.columns, room.rows, room.size.x / static_cast<float>(room.columns),
        room.size.z / static_cast<float>(room.rows));
  return text;
}

}  // namespace sconce::app
