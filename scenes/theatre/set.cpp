// SPDX-License-Identifier: Apache-2.0
// The room that is played in: three flats, and what stands between them.
#include "theatre.h"

namespace sconce::demo {
namespace {

constexpr float kFlatHeight = 3.0f, kThick = 0.07f, kWainscot = 0.85f;

struct Opening {
  float left, right, low, high;
};

/// A wall of `length` along x, its front at z = 0, with at most one opening.
void add_flat(Stage& stage, const std::string& name, const Mat4& place, float length, const Opening* hole) {
  MeshBuilder paper, wood, flat, trim;
  const auto piece = [&](float x0, float x1, float y0, float y1) {
    if (x1 > x0 && y1 > y0) add_box(paper, {x0, y0, -kThick}, {x1, y1, 0}, 0);
  };
  const auto bar = [&](float x0, float x1, float y0, float y1, float deep) {
    if (x1 > x0) add_box(wood, {x0, y0, 0}, {x1, y1, deep}, 0.006f, kBack);
  };
  const Opening o = hole != nullptr ? *hole : Opening{length, length, 0, 0};
  piece(0, o.left, 0, kFlatHeight), piece(o.right, length, 0, kFlatHeight);
  piece(o.left, o.right, 0, o.low), piece(o.left, o.right, o.high, kFlatHeight);
  const float stop = o.low > kWainscot || hole == nullptr ? length : o.left,
              go = o.low > kWainscot || hole == nullptr ? length : o.right;
  for (const auto& [x0, x1] : {std::pair{0.0f, stop}, std::pair{go, length}}) {
    bar(x0, x1, 0, 0.14f, 0.035f), bar(x0, x1, 0.14f, kWainscot - 0.05f, 0.012f);
    bar(x0, x1, kWainscot - 0.05f, kWainscot, 0.04f);
  }
  bar(0, length, kFlatHeight - 0.12f, kFlatHeight, 0.05f);
  if (hole != nullptr) {
    constexpr float kCase = 0.11f;
    bar(o.left - kCase, o.left, std::max(o.low - kCase, 0.0f), o.high + kCase, 0.045f);
    bar(o.right, o.right + kCase, std::max(o.low - kCase, 0.0f), o.high + kCase, 0.045f);
    bar(o.left, o.right, o.high, o.high + kCase, 0.045f);
    if (o.low > 0) bar(o.left, o.right, o.low - kCase, o.low, 0.10f);
  }
  flat.append(paper, place), trim.append(wood, place);
  stage.add(name, "wallpaper", flat);
  stage.add(name + " woodwork", "woodwork", trim);
}

/// Bars between the panes; what glows behind them is a lamp.
void add_window_bars(Stage& stage, const Mat4& place, const Opening& o) {
  MeshBuilder bars, placed;
  constexpr float kBar = 0.035f;
  for (int k = 1; k < 3; ++k) {
    const float x = glm::mix(o.left, o.right, static_cast<float>(k) / 3);
    add_box(bars, {x - kBar / 2, o.low, -0.045f}, {x + kBar / 2, o.high, -0.005f}, 0);
  }
  for (int k = 1; k < 4; ++k) {
    const float y = glm::mix(o.low, o.high, static_cast<float>(k) / 4);
    add_box(bars, {o.left, y - kBar / 2, -0.04f}, {o.right, y + kBar / 2, -0.01f}, 0);
  }
  placed.append(bars, place);
  stage.add("window bars", "woodwork", placed);
}

void add_armchair(Stage& stage, const Mat4& place) {
  MeshBuilder chair, legs, whole, feet;
  add_box(chair, {-0.32f, 0.16f, -0.36f}, {0.32f, 0.44f, 0.36f}, 0.07f);
  add_box(chair, {-0.36f, 0.30f, -0.44f}, {0.36f, 1.02f, -0.26f}, 0.08f);
  for (const float side : {-1.0f, 1.0f}) {
    const float a = side < 0 ? -0.46f : 0.32f;
    add_box(chair, {a, 0.16f, -0.42f}, {a + 0.14f, 0.62f, 0.36f}, 0.06f);
    for (const float z : {-0.36f, 0.30f}) {
      MeshBuilder leg;
      add_lathe(leg, {{0.018f, 0}, {0.028f, 0.17f}}, 10, 40);
      legs.append(leg, move({side * 0.36f, 0, z}));
    }
  }
  whole.append(chair, place), feet.append(legs, place);
  stage.add("armchair", "armchair", whole);
  stage.add("armchair legs", "seat wood", feet);
}

MeshBuilder chair() {
  MeshBuilder out;
  for (const float x : {-0.19f, 0.19f}) {
    add_box(out, {x - 0.02f, 0, 0.15f}, {x + 0.02f, 0.45f, 0.19f}, 0.006f);
    add_box(out, {x - 0.02f, 0, -0.21f}, {x + 0.02f, 0.95f, -0.17f}, 0.006f);
  }
  add_box(out, {-0.23f, 0.44f, -0.22f}, {0.23f, 0.485f, 0.22f}, 0.012f);
  for (const float y : {0.62f, 0.76f, 0.89f})
    add_box(out, {-0.19f, y, -0.205f}, {0.19f, y + 0.06f, -0.18f}, 0.008f);
  return out;
}

void add_table(Stage& stage, Vec3 at) {
  MeshBuilder table, chairs, round, book;
  add_lathe(round,
            smooth_curve<Vec2>({{0.30f, 0},
                                {0.28f, 0.05f},
                                {0.06f, 0.10f},
                                {0.05f, 0.35f},
                                {0.07f, 0.5f},
                                {0.06f, 0.66f},
                                {0.2f, 0.70f}},
                               3),
            24, 50);
  add_lathe(round,
            {{0.2f, 0.70f}, {0.52f, 0.705f}, {0.54f, 0.72f}, {0.535f, 0.745f}, {0.52f, 0.75f}, {0, 0.75f}},
            40, 40);
  table.append(round, move(at));
  stage.add("table", "seat wood", table);
  for (const auto& [angle, out] : {std::pair{62.0f, 0.68f}, std::pair{-98.0f, 0.74f}})
    chairs.append(chair(), move(at) * turn(angle, {0, 1, 0}) * move({0, 0, -out}));
  stage.add("chairs", "seat wood", chairs);
  MeshBuilder closed;
  add_box(closed, {-0.09f, 0, -0.13f}, {0.09f, 0.035f, 0.13f}, 0.006f, kBottom);
  book.append(closed, move(at + Vec3(-0.2f, 0.75f, 0.18f)) * turn(24, {0, 1, 0}));
  stage.add("book", "book", book);
}

void add_shelf(Stage& stage, const Mat4& place) {
  MeshBuilder boards, books, wood, red, clay;
  constexpr float kLeft = 0.75f, kRight = 1.85f, kTop = 1.95f, kDeep = 0.28f;
  for (const float x : {kLeft, kRight - 0.03f})
    add_box(boards, {x, 0, 0.012f}, {x + 0.03f, kTop, kDeep}, 0.004f, kBottom);
  for (int k = 0; k < 5; ++k) {
    const float y = 0.12f + 0.45f * static_cast<float>(k);
    add_box(boards, {kLeft + 0.03f, y, 0.012f}, {kRight - 0.03f, y + 0.028f, kDeep - 0.005f}, 0.004f);
    if (k == 4) break;
    float x = kLeft + 0.06f;
    for (int b = 0; x < kRight - 0.22f - 0.12f * static_cast<float>((k * 7) % 3); ++b) {
      const float wide = 0.028f + 0.007f * static_cast<float>((b * 5 + k * 3) % 4),
                  tall = 0.25f + 0.022f * static_cast<float>((b * 7 + k) % 5);
      add_box(b % 3 == 0   ? clay
              : b % 3 == 1 ? red
                           : books,
              {x, y + 0.028f, 0.04f}, {x + wide, y + 0.028f + tall, 0.21f}, 0.004f, kBottom);
      x += wide + 0.003f;
    }
  }
  for (const auto& [name, material, shape] : {std::tuple{"shelf", "seat wood", &boards},
                                              {"books", "hills", &books},
                                              {"red books", "book", &red},
                                              {"tan books", "armchair", &clay}}) {
    MeshBuilder placed;
    placed.append(*shape, place);
    stage.add(name, material, placed);
  }
}

void add_plant(Stage& stage, Vec3 at) {
  MeshBuilder pot, leaves, placed;
  add_lathe(pot,
            {{0, 0},
             {0.13f, 0},
             {0.19f, 0.30f},
             {0.205f, 0.30f},
             {0.205f, 0.35f},
             {0.18f, 0.35f},
             {0.17f, 0.31f},
             {0, 0.31f}},
            24, 40);
  placed.append(pot, move(at));
  stage.add("pot", "clay", placed);
  for (int k = 0; k < 17; ++k) {
    const float n = static_cast<float>(k), around = 2.39996f * n,
                tall = 0.62f + 0.055f * std::fmod(n * 3.7f, 9.0f),
                reach = 0.16f + 0.05f * std::fmod(n * 2.3f, 7.0f);
    MeshBuilder leaf;
    add_sheet(
        leaf, 2, 7,
        [&](float u, float v) {
          const float wide = 0.055f * std::sin(kPi * std::min(1.0f, 0.12f + 0.9f * v)), across = u - 0.5f;
          return Vec3(0.03f + reach * v * v, tall * v * (1 - 0.25f * v * v) + 0.5f * wide * std::abs(across),
                      2 * wide * across);
        },
        {0.1f, 0.8f}, 70);
    leaves.append(leaf, move(at + Vec3(0, 0.31f, 0)) * turn(around * 180 / kPi, {0, 1, 0}));
  }
  stage.add("plant", "leaf", leaves);
}

}  // namespace

void add_set(Stage& stage) {
  const float angle = 51.34f, length = std::hypot(1.6f, 2.0f);
  const Mat4 left = move({-3.6f, kFloor, -2.6f}) * turn(angle, {0, 1, 0}),
             back = move({-2.0f, kFloor, -4.6f}),
             right = move({2.0f, kFloor, -4.6f}) * turn(-angle, {0, 1, 0});
  const Opening window{0.75f, 1.85f, 0.98f, 2.38f}, door{1.25f, 2.75f, 0, 2.35f};
  add_flat(stage, "flat with window", left, length, &window);
  add_window_bars(stage, left, window);
  add_flat(stage, "flat with door", back, 4, &door);
  add_flat(stage, "flat with shelf", right, length, nullptr);
  add_shelf(stage, right);

  MeshBuilder frames, flat, rug;
  for (const float x : {0.3f, 3.1f}) {
    MeshBuilder frame;
    add_box(frame, {x, 1.35f, 0}, {x + 0.58f, 2.15f, 0.035f}, 0.012f, kBack);
    frames.append(frame, back);
  }
  stage.add("picture frames", "gilding", frames);
  MeshBuilder canvases;
  for (const float x : {0.3f, 3.1f}) {
    MeshBuilder canvas;
    add_box(canvas, {x + 0.07f, 1.42f, 0.035f}, {x + 0.51f, 2.08f, 0.04f}, 0, kBack);
    canvases.append(canvas, back);
  }
  stage.add("pictures", "hills", canvases);
  add_box(flat, {0, 0, 0}, {2.4f, 0.012f, 1.6f}, 0.005f, kBottom);
  rug.append(flat, move({-1.3f, kFloor, -3.35f}) * turn(-3, {0, 1, 0}));
  stage.add("rug", "rug", rug);
  add_armchair(stage, move({-1.55f, kFloor, -2.75f}) * turn(38, {0, 1, 0}));
  add_table(stage, {1.25f, kFloor, -2.45f});
  add_plant(stage, {1.35f, kFloor, -4.15f});
}

}  // namespace sconce::demo
