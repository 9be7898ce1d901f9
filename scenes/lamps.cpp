// SPDX-License-Identifier: Apache-2.0
// Four groups: downlights, globes beside the mirror, hidden strips in the shower, daylight.
#include <string>

#include "bathroom.h"

namespace sconce::demo {
namespace {

// Kelvin.
constexpr double kNeutral = 4000, kWarm = 3000, kSoft = 3500, kDaylight = 7500;
constexpr float kDownlightLumens = 500, kGlobeLumens = 600, kSlotLumens = 420, kShelfLumens = 180,
                kDaylightLumens = 4000;

void add_downlights(Stage& stage) {
  MeshBuilder ring, disk, rings;
  add_lathe(ring,
            {{0.066f, -0.018f},
             {0.070f, -0.040f},
             {0.074f, -0.042f},
             {0.080f, -0.040f},
             {0.082f, -0.036f},
             {0.082f, 0.0f}},
            32, 40);
  add_disk(disk, 0.0665f, 32);
  int count = 0;
  for (const float z : {0.75f, 2.25f})
    for (const float x : {0.95f, 2.45f}) {
      const Vec3 at(x, kHeight, z);
      rings.append(ring, move(at));
      MeshBuilder glow;
      glow.append(disk, move(at + Vec3(0, -0.019f, 0)) * turn(180, {1, 0, 0}));
      stage.add_light("downlight " + std::to_string(++count), glow, "ceiling", kDownlightLumens, kNeutral);
    }
  stage.add("downlight rings", "joinery", rings);
}

void add_globes(Stage& stage) {
  constexpr float kRadius = 0.06f, kOut = 0.105f, kY = 1.56f;
  constexpr int kRings = 14;
  MeshBuilder globe, fitting, holder;
  std::vector<Vec2> profile;
  for (int k = 0; k <= kRings; ++k) {
    const float a = kPi * (static_cast<float>(k) / kRings - 0.5f);
    profile.emplace_back(kRadius * std::cos(a), kRadius * std::sin(a));
  }
  add_lathe(globe, profile, 28, 60);
  const float low = -kRadius;
  add_lathe(holder,
            {{0, low - 0.022f},
             {0.012f, low - 0.022f},
             {0.026f, low - 0.008f},
             {0.034f, low + 0.012f},
             {0.031f, low + 0.013f}},
            20, 40);
  MeshBuilder plate;
  add_lathe(plate, {{0.036f, 0}, {0.036f, 0.006f}, {0.031f, 0.012f}, {0, 0.013f}}, 24, 35);
  const float side_x[2] = {1.03f, 1.95f};
  for (int side = 0; side < 2; ++side) {
    const Vec3 at(side_x[side], kY, kOut), wall(at.x, kY - 0.13f, 0);
    MeshBuilder glow;
    glow.append(globe, move(at));
    stage.add_light("mirror globe " + std::to_string(side + 1), glow, "mirror", kGlobeLumens, kWarm);
    fitting.append(holder, move(at));
    fitting.append(plate, move(wall) * turn(90, {1, 0, 0}));
    add_tube(fitting,
             smooth_curve<Vec3>({wall,
                                 wall + Vec3(0, 0, 0.06f),
                                 {at.x, wall.y + 0.012f, kOut - 0.012f},
                                 {at.x, kY + low - 0.02f, kOut}},
                                5),
             0.007f, 12, false, false);
  }
  stage.add("mirror lamp fittings", "brass", fitting);
}

void add_strips(Stage& stage) {
  MeshBuilder slot, shelf;
  add_rectangle(slot, {kAlcoveLeft + 0.02f, kAlcoveHeight + 0.062f, -kAlcoveDepth + 0.03f},
                {kWidth - kAlcoveLeft - 0.04f, 0, 0}, {0, 0, 0.03f});
  stage.add_light("shower strip", slot, "shower", kSlotLumens, kSoft);
  add_rectangle(shelf, {kAlcoveLeft + 0.245f, 1.394f, -kAlcoveDepth - 0.022f}, {0.41f, 0, 0}, {0, 0, 0.014f});
  stage.add_light("shower shelf strip", shelf, "shower", kShelfLumens, kSoft);
}

void add_daylight(Stage& stage) {
  MeshBuilder portal;
  const Vec3 size = kWindowHi - kWindowLo;
  add_rectangle(portal, {kWindowLo.x, kWindowLo.y, kWindowHi.z}, {0, 0, -size.z}, {0, size.y, 0});
  stage.add_light("daylight", portal, "window", kDaylightLumens, kDaylight);
}

}  // namespace

void add_lamps(Stage& stage) {
  add_downlights(stage);
  add_globes(stage);
  add_strips(stage);
  add_daylight(stage);
}

}  // namespace sconce::demo
