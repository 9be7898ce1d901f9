// SPDX-License-Identifier: Apache-2.0
// Towels on the walls, and the rug. (The one on the tub follows its shape: tub.cpp; rolled ones:
// shelves.cpp.)
#include "bathroom.h"

namespace sconce::demo {
namespace {

float smooth(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// A towel over a bar on the narrow wall between vanity and shower.
void add_bar_towel(Stage& stage) {
  constexpr float kY = 1.52f, kZ = 0.07f, kFrom = 2.135f, kTo = 2.455f, kRadius = 0.008f;
  MeshBuilder bar, plate;
  add_tube(bar, {{kFrom, kY, kZ}, {kTo, kY, kZ}}, kRadius, 12);
  add_lathe(plate, {{0.02f, 0}, {0.02f, 0.004f}, {0.017f, 0.007f}, {0, 0.008f}}, 18, 35);
  for (const float x : {kFrom + 0.012f, kTo - 0.012f}) {
    bar.append(plate, move({x, kY, 0}) * turn(90, {1, 0, 0}));
    add_tube(bar, {{x, kY, 0}, {x, kY, kZ}}, 0.007f, 12, false, false);
  }
  stage.add("towel bar", "brass", bar);

  constexpr float kFront = 0.66f, kBehind = 0.52f, kTurn = 0.013f, kArc = kPi * kTurn,
                  kAll = kFront + kArc + kBehind;
  const auto at = [&](float u, float v) {
    const float s = v * kAll;  // from the front hem over the bar to the back hem
    const float gather = 0.022f, x0 = kFrom + 0.035f, x1 = kTo - 0.035f;
    const auto hang = [&](float below, float side) {
      const float loose = smooth(below / 0.45f);
      const float x = glm::mix(x0, x1, u) + gather * loose * (0.5f - u);
      const float fold = 0.011f * std::sin(15 * u + 0.9f + side) + 0.006f * std::sin(31 * u + 2.1f * below);
      const float z = kZ + side * kTurn + loose * (fold + side * 0.006f + (side < 0 ? -0.012f : 0.006f));
      return Vec3(x, kY - below + 0.006f * loose * std::sin(5 * u), z);
    };
    if (s < kFront) return hang(kFront - s, 1);
    if (s > kFront + kArc) return hang(s - kFront - kArc, -1);
    const float a = (s - kFront) / kTurn;
    return Vec3(glm::mix(x0, x1, u), kY + kTurn * std::sin(a), kZ + kTurn * std::cos(a));
  };
  MeshBuilder towel;
  add_sheet(towel, 24, 44, at, {1, 1});
  stage.add("towel on the bar", "teal towel", towel);
}

/// A bath towel hung by its loop from a hook on the right wall.
void add_hook_towel(Stage& stage) {
  const Vec3 hook(kWidth, 1.66f, 0.36f);
  MeshBuilder peg;
  add_tube(peg,
           smooth_curve<Vec3>({hook, hook + Vec3(-0.03f, -0.004f, 0), hook + Vec3(-0.045f, 0.012f, 0)}, 4),
           0.007f, 12, false);
  add_box(peg, hook + Vec3(-0.007f, -0.03f, -0.012f), hook + Vec3(0, 0.02f, 0.012f), 0.002f, kRight);
  stage.add("towel hook", "brass", peg);

  const auto at = [&](float u, float v) {
    const float t = 1 - v, across = u - 0.5f;
    const float spread = 0.018f + 0.145f * smooth(t * 1.5f) * (0.9f + 0.1f * t);
    const float depth = 0.012f + 0.021f * smooth(t * 3) * (1 - 0.25f * t);
    const float wave = std::cos(2 * kPi * 3.5f * u + 0.6f) + 0.35f * std::sin(19 * u + 4 * t);
    const float drop = t * (0.70f + 0.10f * std::abs(across)) + 0.02f * across * across * smooth(4 * t);
    return hook + Vec3(-0.014f - depth * (1.25f + wave), -0.012f - drop,
                       2 * spread * across + 0.012f * wave * smooth(t * 2));
  };
  MeshBuilder towel;
  add_sheet(towel, 36, 24, at, {1, 1});
  stage.add("towel on the hook", "terracotta towel", towel);
}

void add_rug(Stage& stage) {
  MeshBuilder flat, rug;
  add_box(flat, {0, 0, 0}, {1.1f, 0.014f, 0.7f}, 0.006f, kBottom);
  rug.append(flat, move({1.08f, 0, 0.62f}) * turn(-4, {0, 1, 0}));
  stage.add("rug", "rug", rug);
}

}  // namespace

void add_textiles(Stage& stage) {
  add_bar_towel(stage);
  add_hook_towel(stage);
  add_rug(stage);
}

}  // namespace sconce::demo
