// SPDX-License-Identifier: Apache-2.0
// Walls, floor and ceiling: single faces that look into the room and meet exactly; tiles as geometry.
#include <vector>

#include "bathroom.h"

namespace sconce::demo {
namespace {

struct TileGrid {
  Vec2 tile;  ///< metres
  int columns, rows;
  int hole[4] = {0, 0, 0, 0};  ///< first column, end column, first row, end row

  bool has(int c, int r) const { return c < hole[0] || c >= hole[1] || r < hole[2] || r >= hole[3]; }
};

/// Tiles with bevelled edges that meet in V-shaped joints.
void add_tiles(MeshBuilder& out, Vec3 origin, Vec3 u, Vec3 v, const TileGrid& grid) {
  constexpr float kBevel = 0.006f;
  const Vec3 n = glm::cross(u, v);
  const auto at = [&](float x, float y, float z) { return Corner{origin + x * u + y * v + z * n, {x, y}}; };
  out.part(5);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      if (!grid.has(c, r)) continue;
      const Vec2 lo = grid.tile * Vec2(c, r), hi = grid.tile * Vec2(c + 1, r + 1);
      const Vec2 rim[4] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
      const Vec2 flat[4] = {
          lo + kBevel, {hi.x - kBevel, lo.y + kBevel}, hi - kBevel, {lo.x + kBevel, hi.y - kBevel}};
      const auto up = [&](int k) { return at(flat[k & 3].x, flat[k & 3].y, kTile); };
      const auto edge = [&](int k) { return at(rim[k & 3].x, rim[k & 3].y, kJoint); };
      out.quad(up(0), up(1), up(2), up(3));
      for (int k = 0; k < 4; ++k) out.quad(edge(k), edge(k + 1), up(k + 1), up(k));
    }
}

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

void add_plaster(Stage& stage) {
  MeshBuilder back, left, right, front, reveals;
  add_wall(back, Vec3(0), kX, kY, {0, kDadoRight, kAlcoveLeft, kWidth}, {0, kDado, kAlcoveHeight, kHeight},
           [](std::size_t i, std::size_t j) { return (i == 0 && j == 0) || (i == 2 && j < 2); });
  stage.add("wall back", "plaster", back);
  add_wall(left, {0, 0, kDepth}, -kZ, kY, {0, kDepth - kWindowHi.z, kDepth - kWindowLo.z, kDepth},
           {kDado, kWindowLo.y, kWindowHi.y, kHeight},
           [](std::size_t i, std::size_t j) { return i == 1 && j == 1; });
  stage.add("wall left", "plaster", left);
  add_wall(right, {kWidth, 0, 0}, kZ, kY, {0, kDepth}, {0, kHeight});
  stage.add("wall right", "plaster", right);
  add_wall(front, {kWidth, 0, kDepth}, -kX, kY, {0, kWidth - kDoorRight, kWidth - kDoorLeft, kWidth},
           {0, kDoorHeight, kHeight}, [](std::size_t i, std::size_t j) { return i == 1 && j == 0; });
  stage.add("wall front", "plaster", front);

  const Vec3 lo = kWindowLo, size = kWindowHi - kWindowLo;
  add_rectangle(reveals, lo, kX * size.x, kY * size.y);
  add_rectangle(reveals, {kWindowHi.x, lo.y, kWindowHi.z}, -kX * size.x, kY * size.y);
  add_rectangle(reveals, {lo.x, kWindowHi.y, lo.z}, kX * size.x, kZ * size.z);
  add_rectangle(reveals, {lo.x, lo.y, kWindowHi.z}, kX * size.x, -kZ * size.z);
  add_rectangle(reveals, {kDoorLeft, 0, kDepth + kDoorReveal}, -kZ * kDoorReveal, kY * kDoorHeight);
  add_rectangle(reveals, {kDoorRight, 0, kDepth}, kZ * kDoorReveal, kY * kDoorHeight);
  add_rectangle(reveals, {kDoorLeft, kDoorHeight, kDepth}, kX * (kDoorRight - kDoorLeft), kZ * kDoorReveal);
  stage.add("reveals", "plaster", reveals);
}

void add_ceilings(Stage& stage) {
  MeshBuilder ceiling, shower;
  add_wall(ceiling, {0, kHeight, 0}, kX, kZ, {0, kWidth}, {0, kDepth});
  stage.add("ceiling", "ceiling paint", ceiling);
  add_rectangle(shower, {kAlcoveLeft, kAlcoveHeight, -kAlcoveDepth}, kX * (kWidth - kAlcoveLeft),
                kZ * kAlcoveDepth);
  stage.add("shower ceiling", "ceiling paint", shower);
}

void add_floors(Stage& stage) {
  MeshBuilder floor, tray;
  const auto piece = [&](float x0, float x1, float z0, float z1) {
    floor.part(1);
    const auto at = [](float x, float z) { return Corner{{x, 0, z}, {x, z}}; };
    floor.quad(at(x0, z1), at(x1, z1), at(x1, z0), at(x0, z0));
  };
  piece(0, kWidth, 0, kDepth);
  piece(kDoorLeft, kDoorRight, kDepth, kDepth + kDoorReveal);
  stage.add("floor", "terrazzo", floor);
  // Edges of the tiles at the level of the room's floor: no step, no gap.
  add_tiles(tray, {kAlcoveLeft, -kJoint, 0}, kX, -kZ, {{0.15f, 0.15f}, 6, 6});
  stage.add("shower floor", "shower floor tile", tray);
}

void add_wall_tiles(Stage& stage) {
  constexpr Vec2 kSize{0.075f, 0.2f};
  MeshBuilder dado_left, dado_back, back, left, right;
  add_tiles(dado_left, {0, 0, kDepth}, -kZ, kY, {kSize, 42, 5});
  stage.add("tiles by the tub", "wall tile", dado_left);
  add_tiles(dado_back, Vec3(0), kX, kY, {kSize, 28, 5});
  stage.add("tiles by the vanity", "wall tile", dado_back);
  add_tiles(back, {kAlcoveLeft, 0, -kAlcoveDepth}, kX, kY, {kSize, 12, 12, {3, 9, 5, 7}});
  stage.add("shower tiles back", "wall tile", back, 1.5f);
  add_tiles(left, {kAlcoveLeft, 0, 0}, -kZ, kY, {kSize, 12, 12});
  stage.add("shower tiles left", "wall tile", left);
  add_tiles(right, {kWidth, 0, -kAlcoveDepth}, kZ, kY, {kSize, 12, 12});
  stage.add("shower tiles right", "wall tile", right, 1.5f);
}

}  // namespace

void add_shell(Stage& stage) {
  add_plaster(stage);
  add_ceilings(stage);
  add_floors(stage);
  add_wall_tiles(stage);
}

}  // namespace sconce::demo
