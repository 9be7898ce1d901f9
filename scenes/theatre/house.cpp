// SPDX-License-Identifier: Apache-2.0
// The auditorium: single faces that look into it, panels and mouldings on them.
#include "theatre.h"

namespace sconce::demo {
namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};
constexpr float kDado = 1.15f, kDoorNear = 1.9f, kDoorFar = 3.5f, kDoorHeight = 2.3f, kDoorDeep = 0.35f;

void add_walls(Stage& stage) {
  MeshBuilder walls, arch_wall, ceiling, floor;
  add_wall(walls, {-kHouseHalf, 0, kHouseBack}, -kZ, kY, {0, kHouseBack}, {0, kHouseHeight});
  // The right wall has the way out to the foyer.
  add_wall(walls, {kHouseHalf, 0, 0}, kZ, kY, {0, kDoorNear, kDoorFar, kHouseBack},
           {0, kDoorHeight, kHouseHeight}, [](std::size_t i, std::size_t j) { return i == 1 && j == 0; });
  add_wall(walls, {kHouseHalf, 0, kHouseBack}, -kX, kY, {0, 2 * kHouseHalf}, {0, kHouseHeight});
  add_rectangle(walls, {kHouseHalf, 0, kDoorNear}, kX * kDoorDeep, kY * kDoorHeight);
  add_rectangle(walls, {kHouseHalf + kDoorDeep, 0, kDoorFar}, -kX * kDoorDeep, kY * kDoorHeight);
  add_rectangle(walls, {kHouseHalf, kDoorHeight, kDoorNear}, kX * kDoorDeep, kZ * (kDoorFar - kDoorNear));
  stage.add("house walls", "wall paint", walls);

  const float side = kHouseHalf - kArchHalf;
  add_wall(arch_wall, {-kHouseHalf, 0, 0}, kX, kY, {0, side, side + 2 * kArchHalf, 2 * kHouseHalf},
           {0, kFloor, kArchHeight, kHouseHeight},
           [](std::size_t i, std::size_t j) { return i == 1 && j < 2; });
  stage.add("arch wall", "wall paint", arch_wall);

  add_wall(ceiling, {-kHouseHalf, kHouseHeight, 0}, kX, kZ, {0, 2 * kHouseHalf}, {0, kHouseBack});
  stage.add("house ceiling", "ceiling", ceiling);
  add_wall(floor, {-kHouseHalf, 0, kHouseBack}, kX, -kZ, {0, 2 * kHouseHalf}, {0, kHouseBack});
  add_rectangle(floor, {kHouseHalf, 0, kDoorFar}, kX * kDoorDeep, -kZ * (kDoorFar - kDoorNear));
  stage.add("house floor", "carpet", floor);
}

/// Moulding along x: a gilded bar that steps out of the wall behind it.
void add_bar(MeshBuilder& out, const Mat4& place, float length, float tall, float deep) {
  MeshBuilder bar;
  add_box(bar, {0, 0, 0}, {length, tall, deep}, 0.25f * std::min(tall, deep), kBack);
  out.append(bar, place);
}

/// Dado, fields with gilded frames and a cornice on a wall that looks along `place`'s z; `from` to `to` along
/// its x.
void add_panelling(Stage& stage, const char* name, const Mat4& place, float from, float to, int fields) {
  MeshBuilder dado, gilt, cornice, box;
  add_box(box, {from, 0, 0}, {to, kDado, 0.04f}, 0.01f, kBack | kBottom);
  dado.append(box, place);
  add_bar(gilt, place * move({from, kDado, 0}), to - from, 0.07f, 0.075f);
  add_bar(gilt, place * move({from, 0.14f, 0.04f}), to - from, 0.03f, 0.02f);
  const float pitch = (to - from) / static_cast<float>(fields);
  for (int k = 0; k < fields; ++k) {
    const float x0 = from + pitch * static_cast<float>(k) + 0.28f, x1 = x0 + pitch - 0.56f;
    constexpr float kLow = 1.65f, kHigh = 5.7f, kWide = 0.06f, kThick = 0.035f;
    for (const float y : {kLow, kHigh}) add_bar(gilt, place * move({x0, y, 0}), x1 - x0, kWide, kThick);
    for (const float x : {x0, x1 - kWide}) {
      MeshBuilder post;
      add_box(post, {x, kLow, 0}, {x + kWide, kHigh + kWide, kThick}, 0.25f * kThick, kBack);
      gilt.append(post, place);
    }
  }
  MeshBuilder moulded;
  add_box(moulded, {from, kHouseHeight - 0.5f, 0}, {to, kHouseHeight - 0.34f, 0.12f}, 0.03f, kBack);
  add_box(moulded, {from, kHouseHeight - 0.34f, 0}, {to, kHouseHeight, 0.3f}, 0.05f, kBack | kTop);
  cornice.append(moulded, place);
  stage.add(std::string("dado ") + name, "panel", dado);
  stage.add(std::string("gilt mouldings ") + name, "gilding", gilt);
  stage.add(std::string("cornice ") + name, "ceiling", cornice);
}

/// The gilded frame of the stage, three steps, and the reveal behind it.
void add_arch(Stage& stage) {
  MeshBuilder frame, reveal;
  const float low = kFloor, top = kArchHeight;
  const float widths[3] = {0.16f, 0.30f, 0.52f}, depths[3] = {0.22f, 0.14f, 0.07f};
  float inner = 0;
  for (int k = 0; k < 3; ++k) {
    const float a = kArchHalf + inner, b = kArchHalf + widths[k], lo = top + inner, hi = top + widths[k];
    add_box(frame, {-b, low, 0}, {-a, lo, depths[k]}, 0.025f, kBack | kBottom | kTop);
    add_box(frame, {a, low, 0}, {b, lo, depths[k]}, 0.025f, kBack | kBottom | kTop);
    add_box(frame, {-b, lo, 0}, {b, hi, depths[k]}, 0.025f, kBack);
    inner = widths[k];
  }
  // A cartouche in the middle: an oval boss between two scrolls.
  MeshBuilder boss, scroll;
  add_lathe(boss,
            smooth_curve<Vec2>(
                {{0.5f, 0}, {0.47f, 0.07f}, {0.40f, 0.09f}, {0.36f, 0.06f}, {0.25f, 0.10f}, {0, 0.13f}}, 3),
            40, 50);
  frame.append(boss,
               move({0, kArchHeight + 0.42f, 0.06f}) * turn(90, {1, 0, 0}) * scale({1.25f, 1.4f, 0.8f}));
  std::vector<Vec3> path;
  for (int k = 0; k <= 30; ++k) {
    const float t = static_cast<float>(k) / 30, a = 2 * kPi * 1.35f * t, r = 0.06f + 0.34f * t;
    path.emplace_back(0.75f + r * std::cos(a), kArchHeight + 0.42f + 0.62f * r * std::sin(a), 0.09f);
  }
  add_tube(scroll, path, 0.035f, 10);
  frame.append(scroll, Mat4(1));
  frame.append(scroll, scale({-1, 1, 1}));
  stage.add("arch", "gilding", frame);

  add_rectangle(reveal, {-kArchHalf, low, 0}, -kZ * kArchDepth, kY * (top - low));
  add_rectangle(reveal, {kArchHalf, low, -kArchDepth}, kZ * kArchDepth, kY * (top - low));
  add_rectangle(reveal, {-kArchHalf, top, -kArchDepth}, kX * (2 * kArchHalf), kZ * kArchDepth);
  stage.add("arch reveal", "panel", reveal);
}

void add_coffers(Stage& stage) {
  MeshBuilder beams;
  for (int k = 0; k < 5; ++k) {
    const float z = 1.2f + 2.2f * static_cast<float>(k);
    add_box(beams, {-kHouseHalf + 0.3f, kHouseHeight - 0.22f, z - 0.14f},
            {kHouseHalf - 0.3f, kHouseHeight, z + 0.14f}, 0.03f, kTop);
  }
  stage.add("beams", "seat wood", beams);
}

void add_door_case(Stage& stage) {
  MeshBuilder frame;
  constexpr float kWide = 0.16f;
  const float x0 = kHouseHalf - 0.09f, x1 = kHouseHalf;
  add_box(frame, {x0, 0, kDoorNear - kWide}, {x1, kDoorHeight + kWide, kDoorNear}, 0.015f, kRight | kBottom);
  add_box(frame, {x0, 0, kDoorFar}, {x1, kDoorHeight + kWide, kDoorFar + kWide}, 0.015f, kRight | kBottom);
  add_box(frame, {x0, kDoorHeight, kDoorNear}, {x1, kDoorHeight + kWide, kDoorFar}, 0.015f, kRight);
  stage.add("door case", "seat wood", frame);
}

}  // namespace

void add_house(Stage& stage) {
  add_walls(stage);
  const Mat4 left = move({-kHouseHalf, 0, kHouseBack}) * turn(90, {0, 1, 0}),
             right = move({kHouseHalf, 0, 0}) * turn(-90, {0, 1, 0});
  add_panelling(stage, "left", left, 0.05f, kHouseBack - 0.05f, 4);
  add_panelling(stage, "right", right, kDoorFar + 0.2f, kHouseBack - 0.05f, 3);
  add_arch(stage);
  add_coffers(stage);
  add_door_case(stage);
}

void add_seats(Stage& stage) {
  MeshBuilder cushion, wood, cushions, woods;
  add_box(cushion, {-0.25f, 0.36f, -0.42f}, {0.25f, 0.50f, 0.06f}, 0.045f);
  add_box(cushion, {-0.25f, 0.44f, 0.04f}, {0.25f, 0.98f, 0.14f}, 0.045f);
  add_box(wood, {-0.31f, 0, -0.36f}, {-0.255f, 0.60f, 0.16f}, 0.02f, kBottom);
  add_box(wood, {-0.26f, 0.30f, 0.135f}, {0.26f, 0.94f, 0.165f}, 0.01f);
  for (int row = 0; row < 6; ++row) {
    const float z = 3.6f + 1.05f * static_cast<float>(row), half = 2.3f + 0.22f * static_cast<float>(row);
    const int seats = 10;
    for (int k = 0; k < seats; ++k) {
      // Two blocks with an aisle between; rows bent round the stage.
      const float across = (static_cast<float>(k) - 4.5f) * 0.62f + (k < 5 ? -0.45f : 0.45f);
      const float angle = across / (9 + half) * 0.9f;
      const Mat4 at = move({across * 1.22f, 0, z - 1.1f * (std::cos(angle * 3) * -1 + 1)}) *
                      turn(-angle * 120 / kPi, {0, 1, 0});
      cushions.append(cushion, at);
      woods.append(wood, at);
      if (k == 4 || k == 9) woods.append(wood, at * scale({-1, 1, 1}));
    }
  }
  stage.add("seats", "velvet", cushions);
  stage.add("seat frames", "seat wood", woods);
}

}  // namespace sconce::demo
