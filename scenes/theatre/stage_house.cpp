// SPDX-License-Identifier: Apache-2.0
// What surrounds the set: floor, dark walls, the cloth that is the sky, hills cut out of board, pipes with
// lamps.
#include <functional>

#include "theatre.h"

namespace sconce::demo {
namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

void add_floor(Stage& stage) {
  MeshBuilder floor, front;
  add_wall(floor, {-kFlyHalf, kFloor, -kArchDepth}, kX, -kZ, {0, 2 * kFlyHalf}, {0, -kArchDepth - kFlyBack});
  add_rectangle(floor, {-kArchHalf, kFloor, 0}, kX * (2 * kArchHalf), -kZ * kArchDepth);
  floor.part(1), front.part(20);
  constexpr int kPieces = 28;
  const auto x = [](int k) { return -5.6f + 11.2f * static_cast<float>(k) / kPieces; };
  float along = 0;
  for (int k = 0; k < kPieces; ++k) {
    const float a = x(k), b = x(k + 1), za = apron_edge(a), zb = apron_edge(b);
    floor.quad({{a, kFloor, za}, {a, za}}, {{b, kFloor, zb}, {b, zb}}, {{b, kFloor, 0}, {b, 0}},
               {{a, kFloor, 0}, {a, 0}});
    const float next = along + std::hypot(b - a, zb - za);
    front.quad({{a, 0, za}, {along, 0}}, {{b, 0, zb}, {next, 0}}, {{b, kFloor, zb}, {next, kFloor}},
               {{a, kFloor, za}, {along, kFloor}});
    along = next;
  }
  for (const float side : {-1.0f, 1.0f}) {
    const float edge = apron_edge(5.6f);
    MeshBuilder end;
    add_rectangle(end, {-5.6f, 0, 0}, kZ * edge, kY * kFloor);
    front.append(end, scale({-side, 1, 1}));
  }
  stage.add("stage floor", "boards", floor);
  stage.add("stage front", "panel", front);
}

void add_dark_walls(Stage& stage) {
  MeshBuilder walls;
  const float depth = -kArchDepth - kFlyBack, side = kFlyHalf - kArchHalf;
  add_wall(walls, {-kFlyHalf, kFloor, -kArchDepth}, -kZ, kY, {0, depth}, {0, kFlyHeight - kFloor});
  add_wall(walls, {kFlyHalf, kFloor, kFlyBack}, kZ, kY, {0, depth}, {0, kFlyHeight - kFloor});
  add_wall(walls, {-kFlyHalf, kFloor, kFlyBack}, kX, kY, {0, 2 * kFlyHalf}, {0, kFlyHeight - kFloor});
  add_wall(walls, {-kFlyHalf, kFlyHeight, kFlyBack}, kX, kZ, {0, 2 * kFlyHalf}, {0, depth});
  add_wall(walls, {kFlyHalf, kFloor, -kArchDepth}, -kX, kY, {0, side, side + 2 * kArchHalf, 2 * kFlyHalf},
           {0, kArchHeight - kFloor, kFlyHeight - kFloor},
           [](std::size_t i, std::size_t j) { return i == 1 && j == 0; });
  stage.add("stage walls", "black", walls);
}

/// A board cut out along a line of hills.
void add_hills(Stage& stage, const char* name, const char* material, float z,
               const std::function<float(float)>& height) {
  MeshBuilder board;
  constexpr int kPieces = 64;
  constexpr float kHalf = 6.2f, kThick = 0.03f;
  for (int k = 0; k < kPieces; ++k) {
    const auto at = [&](int i) { return -kHalf + 2 * kHalf * static_cast<float>(i) / kPieces; };
    const float a = at(k), b = at(k + 1), ha = kFloor + height(a), hb = kFloor + height(b);
    board.part(1);
    board.quad({{a, kFloor, z}}, {{b, kFloor, z}}, {{b, hb, z}}, {{a, ha, z}});
    board.part(1);
    board.quad({{b, kFloor, z - kThick}}, {{a, kFloor, z - kThick}}, {{a, ha, z - kThick}},
               {{b, hb, z - kThick}});
    board.part(30);
    board.quad({{a, ha, z}}, {{b, hb, z}}, {{b, hb, z - kThick}}, {{a, ha, z - kThick}});
  }
  stage.add(name, material, board);
}

void add_sky(Stage& stage) {
  MeshBuilder cloth;
  add_box(cloth, {-6.3f, kFloor, -7.94f}, {6.3f, 7.4f, -7.9f}, 0);
  stage.add("sky cloth", "sky cloth", cloth);
  add_hills(stage, "hills", "hills", -7.25f, [](float x) {
    return 0.85f + 0.32f * std::sin(0.9f * x + 0.5f) + 0.16f * std::sin(2.3f * x + 2) +
           0.05f * std::sin(7.1f * x);
  });
  add_hills(stage, "near hills", "near hills", -6.75f, [](float x) {
    const float cypress = std::max(0.0f, 1 - std::abs(std::fmod(x + 20.3f, 2.9f) - 1.4f) / 0.22f);
    return 0.38f + 0.2f * std::sin(1.3f * x + 2.6f) + 0.06f * std::sin(5.3f * x) + 0.95f * cypress * cypress;
  });
}

/// A pipe with lamp housings, hung by wires; each housing looks along its own direction.
void add_pipe(MeshBuilder& out, float y, float z, float half, float roof, const std::vector<float>& xs,
              Vec3 look) {
  add_tube(out, {{-half, y, z}, {half, y, z}}, 0.028f, 10);
  for (const float x : {-half + 0.3f, 0.0f, half - 0.3f})
    add_tube(out, {{x, y, z}, {x, roof, z}}, 0.008f, 6, false, false);
  const Frame frame(glm::normalize(look));
  for (const float x : xs) {
    MeshBuilder can;
    add_lathe(can,
              {{0, 0.0f},
               {0.085f, 0.005f},
               {0.11f, 0.09f},
               {0.11f, 0.34f},
               {0.125f, 0.36f},
               {0.118f, 0.362f},
               {0.1f, 0.30f},
               {0, 0.29f}},
              16, 40);
    Mat4 place(1);
    place[0] = glm::vec4(frame.x, 0), place[1] = glm::vec4(frame.z, 0), place[2] = glm::vec4(-frame.y, 0);
    out.append(can, move({x, y - 0.2f, z}) * place * move({0, -0.17f, 0}));
    add_box(out, {x - 0.015f, y - 0.18f, z - 0.02f}, {x + 0.015f, y + 0.03f, z + 0.02f}, 0);
  }
}

void add_pipes(Stage& stage) {
  MeshBuilder front, back;
  add_pipe(front, kFrontPipe.y, kFrontPipe.z, 4.6f, kHouseHeight, {-3.6f, -2.4f, -1.2f, 1.2f, 2.4f, 3.6f},
           {0, -0.62f, -1});
  add_pipe(back, kBackPipe.y, kBackPipe.z, 4.6f, kFlyHeight,
           {-3.6f, -2.8f, -2.0f, -1.2f, -0.4f, 0.4f, 1.2f, 2.0f, 2.8f, 3.6f}, {0, -1.25f, 1});
  stage.add("front pipe", "iron", front);
  stage.add("back pipe", "iron", back);
  MeshBuilder booms;
  for (const float side : {-1.0f, 1.0f}) {
    MeshBuilder boom;
    add_tube(boom, {{4.9f, kFloor, -1.5f}, {4.9f, kFloor + 3.4f, -1.5f}}, 0.028f, 10);
    MeshBuilder foot;
    add_lathe(foot, {{0.3f, 0}, {0.3f, 0.02f}, {0.05f, 0.05f}}, 20, 40);
    boom.append(foot, move({4.9f, kFloor, -1.5f}));
    booms.append(boom, scale({side, 1, 1}));
  }
  stage.add("booms", "iron", booms);
}

}  // namespace

void add_stage_house(Stage& stage) {
  add_floor(stage);
  add_dark_walls(stage);
  add_sky(stage);
  add_pipes(stage);
}

}  // namespace sconce::demo
