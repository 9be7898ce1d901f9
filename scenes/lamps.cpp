// SPDX-License-Identifier: Apache-2.0
// Four groups: downlights, globes beside the mirror, strips in the shower, daylight.
#include <string>

#include "bathroom.h"

namespace sconce::demo {
namespace {

// Kelvin.
constexpr double kNeutral = 4000, kWarm = 3000, kSoft = 3500, kDaylight = 7500;
constexpr float kDownlightLumens = 500, kGlobeLumens = 600, kStripLumens = 540, kShelfLumens = 60,
                kDaylightLumens = 4000;

void add_downlights(Stage& stage) {
  MeshBuilder ring, disk, rings;
  // The glowing face is flush with its ring: a lamp in a recess lights little but its own rim, and brightly.
  constexpr float kGlow = 0.068f, kLow = -0.04f;
  add_lathe(ring, {{kGlow, kLow}, {0.078f, kLow}, {0.082f, kLow + 0.004f}, {0.082f, 0.0f}}, 32, 40);
  add_disk(disk, kGlow, 32);
  int count = 0;
  for (const float z : {0.45f, 2.15f})
    for (const float x : {0.95f, 2.45f}) {
      const Vec3 at(x, kHeight, z);
      rings.append(ring, move(at));
      MeshBuilder glow;
      glow.append(disk, move(at + Vec3(0, kLow, 0)) * turn(180, {1, 0, 0}));
      stage.add_light("downlight " + std::to_string(++count), glow, "ceiling", kDownlightLumens, kNeutral);
    }
  stage.add("downlight rings", "joinery", rings);
}

void add_globes(Stage& stage) {
  constexpr float kRadius = 0.075f, kOut = 0.155f, kY = 1.56f;
  constexpr int kRings = 14;
  MeshBuilder globe, fitting;
  std::vector<Vec2> profile;
  for (int k = 0; k <= kRings; ++k) {
    const float a = kPi * (static_cast<float>(k) / kRings - 0.5f);
    profile.emplace_back(kRadius * std::cos(a), kRadius * std::sin(a));
  }
  add_lathe(globe, profile, 28, 60);
  // A wide brass plate keeps the wall behind the glass from being the brightest spot of the room.
  MeshBuilder plate;
  add_lathe(plate,
            smooth_curve<Vec2>({{0.085f, 0},
                                {0.0855f, 0.006f},
                                {0.082f, 0.011f},
                                {0.074f, 0.012f},
                                {0.055f, 0.008f},
                                {0.03f, 0.006f},
                                {0, 0.0055f}},
                               2),
            36, 50);
  const float side_x[2] = {1.12f, 2.00f};
  for (int side = 0; side < 2; ++side) {
    const Vec3 at(side_x[side], kY, kOut), wall(at.x, kY, 0);
    MeshBuilder glow;
    glow.append(globe, move(at));
    stage.add_light("mirror globe " + std::to_string(side + 1), glow, "mirror", kGlobeLumens, kWarm);
    fitting.append(plate, move(wall) * turn(90, {1, 0, 0}));
    // Only a slender collar meets the glass: a cup would glow, and be sampled by few paths.
    const float foot = kY - kRadius;
    add_tube(fitting,
             smooth_curve<Vec3>({wall + Vec3(0, -0.055f, 0.004f),
                                 wall + Vec3(0, -0.085f, 0.05f),
                                 {at.x, foot - 0.050f, kOut - 0.045f},
                                 {at.x, foot - 0.040f, kOut - 0.010f},
                                 {at.x, foot - 0.015f, kOut}},
                                5),
             0.007f, 12, false, false);
    add_tube(fitting, {{at.x, foot - 0.026f, kOut}, {at.x, foot + 0.001f, kOut}}, 0.013f, 14, true, false);
  }
  stage.add("mirror lamp fittings", "brass", fitting);
}

/// A luminous strip that looks down, in the mouth of a flat profile under a ceiling.
void add_strip(Stage& stage, MeshBuilder& profiles, const char* name, Vec3 lo, Vec3 hi, float lumens) {
  MeshBuilder glow;
  add_rectangle(glow, lo, {hi.x - lo.x, 0, 0}, {0, 0, hi.z - lo.z});
  add_box(profiles, lo, hi, 0, kTop | kBottom);
  stage.add_light(name, glow, "shower", lumens, kSoft);
}

void add_strips(Stage& stage) {
  MeshBuilder profiles;
  constexpr float kTall = 0.008f, kWide = 0.024f;
  const float back = -kAlcoveDepth + 0.28f, shelf_top = 1.4f, shelf_front = -kAlcoveDepth - 0.01f;
  add_strip(stage, profiles, "shower strip", {kAlcoveLeft + 0.06f, kAlcoveHeight - kTall, back},
            {kWidth - 0.06f, kAlcoveHeight, back + kWide}, kStripLumens);
  add_strip(stage, profiles, "shower shelf strip",
            {kAlcoveLeft + 0.245f, shelf_top - kTall, shelf_front - 0.014f},
            {kAlcoveLeft + 0.655f, shelf_top, shelf_front}, kShelfLumens);
  stage.add("strip profiles", "joinery", profiles);
}

void add_daylight(Stage& stage) {
  MeshBuilder portal;
  const Vec3 size = kWindowHi - kWindowLo;
  add_rectangle(portal, {kWindowLo.x, kWindowLo.y, kWindowHi.z}, {0, 0, -size.z}, {0, size.y, 0});
  stage.add_light("daylight", portal, "window", kDaylightLumens, kDaylight, 0.04f);
}

}  // namespace

void add_lamps(Stage& stage) {
  add_downlights(stage);
  add_globes(stage);
  add_strips(stage);
  add_daylight(stage);
}

}  // namespace sconce::demo
