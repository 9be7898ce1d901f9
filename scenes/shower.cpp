// SPDX-License-Identifier: Apache-2.0
// Rain shower, mixer and hand shower, and the stone shelf let into the tiles.
#include "bathroom.h"
#include "vessels.h"

namespace sconce::demo {
namespace {

void add_wall_shelf(Stage& stage) {
  // The hole that the tiles leave (shell.cpp): columns 3 to 9, rows 5 to 7.
  const Vec3 lo(kAlcoveLeft + 0.225f, 1.0f, -kAlcoveDepth - 0.1f),
      hi(kAlcoveLeft + 0.675f, 1.4f, -kAlcoveDepth + kJoint);
  const Vec3 x(hi.x - lo.x, 0, 0), y(0, hi.y - lo.y, 0), z(0, 0, hi.z - lo.z);
  MeshBuilder shelf;
  add_rectangle(shelf, lo, x, y);
  add_rectangle(shelf, lo + z, -z, y);
  add_rectangle(shelf, lo + x, z, y);
  add_rectangle(shelf, lo + z, x, -z);
  add_rectangle(shelf, lo + y, x, z);
  stage.add("shower shelf", "stone", shelf);
  const float back = lo.z + 0.052f;
  add_vessel(stage, "shampoo", "amber glass", pump_bottle(0.032f, 0.15f), {lo.x + 0.09f, lo.y, back});
  add_vessel(stage, "shampoo pump", "black steel", pump(0.15f), {lo.x + 0.09f, lo.y, back}, -60);
  add_vessel(stage, "conditioner", "sage bottle", pump_bottle(0.032f, 0.13f), {lo.x + 0.18f, lo.y, back});
  add_vessel(stage, "conditioner pump", "black steel", pump(0.13f), {lo.x + 0.18f, lo.y, back}, -100);
  add_vessel(stage, "jar of salt", "linen", jar(0.042f, 0.07f), {lo.x + 0.33f, lo.y, back});
}

void add_fittings(Stage& stage) {
  const float wall = kWidth - kTile;
  MeshBuilder brass, head, rose;
  // Overhead: arm out of the right wall, head above the middle of the floor.
  const Vec3 from(wall, 2.16f, -0.45f), over(kAlcoveLeft + 0.47f, 2.16f, -0.45f);
  add_lathe(rose, {{0.032f, 0}, {0.032f, 0.004f}, {0.028f, 0.008f}, {0.012f, 0.009f}}, 20, 35);
  const Mat4 from_right_wall = turn(90, {0, 0, 1});
  brass.append(rose, move(from) * from_right_wall);
  add_tube(
      brass,
      smooth_curve<Vec3>(
          {from, over + Vec3(0.10f, 0, 0), over + Vec3(0.025f, -0.012f, 0), over + Vec3(0, -0.05f, 0)}, 5),
      0.0115f, 14, false);
  add_lathe(head,
            {{0, -0.022f},
             {0.118f, -0.022f},
             {0.124f, -0.019f},
             {0.124f, -0.013f},
             {0.118f, -0.010f},
             {0.030f, -0.004f},
             {0.016f, 0.012f},
             {0.014f, 0.02f}},
            36, 35);
  brass.append(head, move(over + Vec3(0, -0.06f, 0)));

  // Mixer bar and riser rail on the same wall.
  const float x = wall - 0.055f;
  const Vec3 bar(x, 1.05f, -0.45f);
  add_tube(brass, {bar + Vec3(0, 0, -0.13f), bar + Vec3(0, 0, 0.13f)}, 0.021f, 18);
  for (const float z : {-0.155f, 0.155f}) {
    add_tube(brass, {bar + Vec3(0, 0, z - 0.022f), bar + Vec3(0, 0, z + 0.022f)}, 0.025f, 18);
    const Vec3 inlet(wall, bar.y, bar.z + z * 0.5f);
    brass.append(rose, move(inlet) * from_right_wall);
    add_tube(brass, {inlet, inlet + Vec3(-0.05f, 0, 0)}, 0.014f, 12, false, false);
  }
  const Vec3 rail(x, 0, -0.66f);
  add_tube(brass, {rail + Vec3(0, 1.12f, 0), rail + Vec3(0, 1.82f, 0)}, 0.0095f, 12);
  for (const float y : {1.14f, 1.80f}) {
    brass.append(rose, move({wall, y, rail.z}) * from_right_wall);
    add_tube(brass, {{wall, y, rail.z}, {x, y, rail.z}}, 0.009f, 12, false);
  }
  const Vec3 hand = rail + Vec3(-0.045f, 1.66f, 0.0f);
  add_tube(brass, {rail + Vec3(0.012f, 1.66f, 0), rail + Vec3(-0.06f, 1.66f, 0)}, 0.016f, 12);
  add_tube(brass, {hand + Vec3(0.012f, -0.10f, 0), hand, hand + Vec3(-0.02f, 0.10f, 0)}, 0.0115f, 12);
  MeshBuilder spray;
  add_lathe(
      spray,
      {{0, -0.012f}, {0.044f, -0.012f}, {0.048f, -0.008f}, {0.046f, 0.002f}, {0.02f, 0.014f}, {0, 0.016f}},
      24, 35);
  brass.append(spray, move(hand + Vec3(-0.042f, 0.115f, 0)) * turn(-62, {0, 0, 1}));
  add_tube(brass,
           smooth_curve<Vec3>({hand + Vec3(0.012f, -0.098f, 0), hand + Vec3(0.016f, -0.3f, 0.02f),
                               hand + Vec3(0.0f, -0.72f, 0.05f), hand + Vec3(0.0f, -0.93f, 0.10f),
                               bar + Vec3(-0.005f, -0.20f, 0.0f), bar + Vec3(0, -0.02f, 0)},
                              7),
           0.0055f, 8, false, false);
  stage.add("shower fittings", "brass", brass);

  MeshBuilder drain;
  add_box(drain, {kAlcoveLeft + 0.06f, 0.003f, -kAlcoveDepth + 0.05f},
          {kWidth - 0.06f, 0.008f, -kAlcoveDepth + 0.11f}, 0.002f, kBottom);
  stage.add("shower drain", "black steel", drain);
}

}  // namespace

void add_shower(Stage& stage) {
  add_wall_shelf(stage);
  add_fittings(stage);
}

}  // namespace sconce::demo
