// SPDX-License-Identifier: Apache-2.0
#include "vaults.h"

#include <cmath>

#include "stage.h"

namespace sconce::demo {

namespace {

/// Half an ellipse in the plane z = 0 from (-a, 0) over (0, b), a rectangle of `depth` along z and `thick`
/// outwards.
void add_arch(MeshBuilder& out, float a, float b, float thick, float depth, int segments) {
  std::vector<std::vector<Vec3>> rings;
  for (int i = 0; i <= segments; ++i) {
    const float t = kPi * (1 - static_cast<float>(i) / static_cast<float>(segments));
    const Vec3 in(a * std::cos(t), b * std::sin(t), 0),
        outer((a + thick) * std::cos(t), (b + thick) * std::sin(t), 0), half(0, 0, 0.5f * depth);
    rings.push_back({in - half, outer - half, outer + half, in + half});
  }
  add_loft(out, rings, 40);
}

}  // namespace

Scene make_crypt() {
  constexpr float kHalf = 3, kLength = 9, kSpring = 1.8f, kRise = 1.4f, kBay = kLength / 3;
  constexpr int kSegments = 10, kRibSegments = 6;
  Stage stage;
  stage.scene.name = "crypt";
  stage.paint("stone", "b8ab98"), stage.paint("flags", "8e8778"), stage.paint("rib", "cbbfae");
  MeshBuilder floor, walls, vault, ribs, columns;
  floor.part(1), walls.part(1);
  add_rectangle(floor, Vec3(-kHalf, 0, 0), Vec3(0, 0, kLength), Vec3(2 * kHalf, 0, 0));
  const Vec3 side(0, kSpring, 0), end(0, kSpring + kRise, 0), along(0, 0, kLength), across(2 * kHalf, 0, 0);
  add_rectangle(walls, Vec3(-kHalf, 0, 0), side, along), add_rectangle(walls, Vec3(kHalf, 0, 0), along, side);
  add_rectangle(walls, Vec3(-kHalf, 0, 0), across, end),
      add_rectangle(walls, Vec3(-kHalf, 0, kLength), end, across);
  vault.part(40);
  const auto at = [&](int i, float z) {
    const float t = kPi * (1 - static_cast<float>(i) / kSegments);
    return Corner{Vec3(kHalf * std::cos(t), kSpring + kRise * std::sin(t), z)};
  };
  for (int bay = 0; bay < 3; ++bay)
    for (int i = 0; i < kSegments; ++i) {
      const float z0 = kBay * static_cast<float>(bay), z1 = z0 + kBay;
      vault.quad(at(i, z0), at(i + 1, z0), at(i + 1, z1), at(i, z1));
    }
  MeshBuilder rib;
  add_arch(rib, kHalf - 0.22f, kRise - 0.2f, 0.2f, 0.3f, kRibSegments);
  for (int i = 0; i < 4; ++i)
    ribs.append(rib, move(Vec3(0, kSpring, 0.15f + (kLength - 0.3f) * static_cast<float>(i) / 3)));
  for (int i = 0; i < 6; ++i) {
    const float x = i % 2 == 0 ? -1.4f : 1.4f, z = kBay * (0.5f + static_cast<float>(i / 2));
    MeshBuilder column;
    add_lathe(column, {{0.17f, 0.25f}, {0.15f, 2.1f}}, 8, 50);
    add_box(column, Vec3(-0.25f, 0, -0.25f), Vec3(0.25f, 0.25f, 0.25f), 0);
    add_box(column, Vec3(-0.25f, 2.1f, -0.25f), Vec3(0.25f, 2.95f, 0.25f), 0);
    columns.append(column, move(Vec3(x, 0, z)));
  }
  stage.add("floor", "flags", floor), stage.add("walls", "stone", walls), stage.add("vault", "stone", vault);
  stage.add("ribs", "rib", ribs), stage.add("columns", "rib", columns);
  stage.camera("nave", Vec3(0.3f, 1.5f, 0.5f), Vec3(0, 1.2f, 6), 75);
  return std::move(stage.scene);
}

Scene make_cloister() {
  constexpr float kOuter = 7, kGarth = 4.2f, kWall = 4, kPlinth = 0.6f, kShaft = 1.5f, kArch = 0.5f;
  constexpr int kArches = 7;
  constexpr float kPitch = 2 * kGarth / kArches;
  Stage stage;
  stage.scene.name = "cloister";
  stage.paint("stone", "c4b8a2"), stage.paint("flags", "93897a"), stage.paint("grass", "5c7040");
  stage.paint("wood", "6a5340", true);
  MeshBuilder floor, grass, walls, roof, arcade;
  floor.part(1), grass.part(1), walls.part(1), roof.part(1);
  add_rectangle(floor, Vec3(-kOuter, 0, -kOuter), Vec3(0, 0, 2 * kOuter), Vec3(2 * kOuter, 0, 0));
  add_rectangle(grass, Vec3(-kGarth, 0.05f, -kGarth), Vec3(0, 0, 2 * kGarth), Vec3(2 * kGarth, 0, 0));
  const float spring = kPlinth + kShaft, top = spring + kArch + 0.35f;
  MeshBuilder column;  // base, shaft with entasis, capital
  add_lathe(column,
            {{0.12f, kPlinth},
             {0.12f, kPlinth + 0.06f},
             {0.085f, kPlinth + 0.12f},
             {0.08f, kPlinth + 0.7f},
             {0.07f, spring - 0.2f},
             {0.1f, spring - 0.08f},
             {0.13f, spring}},
            10, 40);
  MeshBuilder arch, side;
  add_arch(arch, 0.5f * kPitch - 0.08f, kArch, 0.12f, 0.34f, 10);
  for (int i = 0; i < kArches; ++i) {
    const float x = -kGarth + kPitch * (static_cast<float>(i) + 0.5f);
    side.append(arch, move(Vec3(x, spring, kGarth)));
    if (i == 0) continue;
    for (const float z : {-0.12f, 0.12f}) side.append(column, move(Vec3(x - 0.5f * kPitch, 0, kGarth + z)));
  }
  add_box(side, Vec3(-kGarth - 0.2f, 0, kGarth - 0.2f), Vec3(kGarth - 0.2f, kPlinth, kGarth + 0.2f), 0);
  add_box(side, Vec3(-kGarth - 0.2f, spring + kArch + 0.1f, kGarth - 0.2f),
          Vec3(kGarth - 0.2f, top, kGarth + 0.2f), 0);
  add_box(side, Vec3(-kGarth - 0.2f, kPlinth, kGarth - 0.2f), Vec3(-kGarth + 0.2f, top, kGarth + 0.2f),
          0);  // pier
  side.part(1);
  MeshBuilder wall;
  wall.part(1);
  add_rectangle(wall, Vec3(-kOuter, 0, kOuter), Vec3(0, kWall, 0), Vec3(2 * kOuter, 0, 0));
  MeshBuilder lean;  // roof of one walk
  lean.part(1);
  lean.quad({Vec3(-kOuter, kWall - 0.3f, kOuter)}, {Vec3(kOuter, kWall - 0.3f, kOuter)},
            {Vec3(kGarth - 0.2f, top, kGarth - 0.2f)}, {Vec3(-kGarth + 0.2f, top, kGarth - 0.2f)});
  for (int i = 0; i < 4; ++i) {
    const Mat4 around = turn(90.0f * static_cast<float>(i), Vec3(0, 1, 0));
    arcade.append(side, around), walls.append(wall, around), roof.append(lean, around);
  }
  stage.add("floor", "flags", floor), stage.add("grass", "grass", grass), stage.add("walls", "stone", walls);
  stage.add("roof", "wood", roof), stage.add("arcade", "stone", arcade);
  stage.camera("walk", Vec3(-5.6f, 1.6f, 6.2f), Vec3(-4.6f, 1.3f, -2), 75);
  return std::move(stage.scene);
}

}  // namespace sconce::demo
