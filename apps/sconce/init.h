// SPDX-License-Identifier: Apache-2.0
// What `init` writes: a side file for a scene, or a room with one.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

namespace sconce::app {

/// A commented side file: every group with its lamps and lumens, cameras, what looks wrong. All of it says
/// what is so already, most of it commented out. @param name  of the scene's file
std::string side_file_for(const Scene& scene, const std::string& name);

struct RoomRequest {
  Vec3 size{8, 2.8f, 6};  ///< width along x, height, depth along z, metres
  float ceiling = 0.7f, walls = 0.5f, floor = 0.2f;
  std::string luminaire;  ///< photometric file; empty: no lamps
  int columns = 1, rows = 1;
  float mount = 0;  ///< metres above the floor; 0 = at the ceiling
};

/// An empty room, its floor at y = 0 and its middle at x = z = 0, with a camera in a corner.
Scene make_room(const RoomRequest& room);
/// Its side file: luminaires evenly spread, half a pitch from the walls; a measuring hint.
std::string room_side_file(const RoomRequest& room, const std::string& name);

}  // namespace sconce::app
