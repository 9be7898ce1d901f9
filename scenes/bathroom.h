// SPDX-License-Identifier: Apache-2.0
// The demo scene: a bathroom of 3.4 x 3.15 x 2.5 m with a shower alcove and four groups of lamps.
// Axes: x from the tub's wall to the right, y up, z from the vanity's wall towards the door.
#pragma once

#include "stage.h"

namespace sconce::demo {

inline constexpr float kWidth = 3.4f, kDepth = 3.15f, kHeight = 2.5f;
inline constexpr float kAlcoveLeft = 2.5f, kAlcoveDepth = 0.9f, kAlcoveHeight = 2.4f;
inline constexpr float kDado = 1.0f;       ///< top of the tiles on the walls of the room
inline constexpr float kDadoRight = 2.1f;  ///< their end on the vanity's wall
inline constexpr float kTile = 0.008f;     ///< how far a tile stands out from the wall
inline constexpr float kJoint = 0.0025f;   ///< and its edges
inline constexpr Vec3 kWindowLo{-0.14f, 1.05f, 0.5f}, kWindowHi{0, 2.15f, 1.65f};
inline constexpr float kDoorLeft = 1.8f, kDoorRight = 2.75f, kDoorHeight = 2.1f, kDoorReveal = 0.22f;

void add_materials(Stage& stage);
void add_shell(Stage& stage);     ///< walls, floor, ceiling, tiles
void add_joinery(Stage& stage);   ///< window, door, skirting, trims
void add_tub(Stage& stage);       ///< with its tap and the towel over its rim
void add_vanity(Stage& stage);    ///< cabinet, basin, tap, mirror
void add_shower(Stage& stage);    ///< fittings and the shelf in the wall
void add_textiles(Stage& stage);  ///< towels on the walls, rug
void add_shelves(Stage& stage);   ///< boards, bottles, jars
void add_plants(Stage& stage);
void add_lamps(Stage& stage);

/// All of it, with cameras.
Scene make_bathroom();

}  // namespace sconce::demo
