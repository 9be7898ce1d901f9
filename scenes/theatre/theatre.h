// SPDX-License-Identifier: Apache-2.0
// A small playhouse: 13 m wide, 60 seats, a stage behind a gilded arch with a room on it and a sky behind it.
// Axes: x to the right of who sits in the house, y up, z from the stage towards the house; the wall with the
// arch stands at z = 0. Lamps that are things to be seen are meshes here; the spotlights stand in
// theatre.toml.
#pragma once

#include "stage.h"

namespace sconce::demo {

inline constexpr float kHouseHalf = 6.5f, kHouseBack = 11, kHouseHeight = 7.6f;
inline constexpr float kFlyHalf = 7, kFlyBack = -8.5f, kFlyHeight = 8.6f;
inline constexpr float kFloor = 0.9f;  ///< of the stage
inline constexpr float kArchHalf = 4.2f, kArchHeight = 6, kArchDepth = 0.4f;
inline constexpr float kApron = 1.5f;  ///< how far the stage's floor comes forward in the middle

inline constexpr Vec3 kFrontPipe{0, 6.5f, 6.2f}, kBackPipe{0, 6.3f, -5.6f};  ///< where spotlights hang

/// Where the edge of the stage's floor is.
inline float apron_edge(float x) {
  const float t = x / 5.6f;
  return 0.35f + (kApron - 0.35f) * (1 - t * t);
}

void add_theatre_materials(Stage& stage);
void add_house(Stage& stage);  ///< walls, arch, ceiling, floor of the auditorium
void add_seats(Stage& stage);
void add_stage_house(Stage& stage);  ///< floor, dark walls, sky cloth, hills, pipes
void add_drapes(Stage& stage);       ///< curtain, valance, legs and borders
void add_set(Stage& stage);          ///< the room that is played in
void add_theatre_lamps(Stage& stage);

/// All of it, with cameras.
Scene make_theatre();

}  // namespace sconce::demo
