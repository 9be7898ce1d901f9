// SPDX-License-Identifier: Apache-2.0
// Two boards beside the window with what stands on them, the things on the vanity, and a stool.
#include "bathroom.h"
#include "vessels.h"

namespace sconce::demo {
namespace {

constexpr float kLow = 1.42f, kHigh = 1.78f, kBoard = 0.026f;
constexpr float kFromX = 0.10f, kToX = 0.74f, kShelfDepth = 0.18f;

void add_boards(Stage& stage) {
  MeshBuilder boards, brackets;
  for (const float y : {kLow, kHigh}) {
    add_box(boards, {kFromX, y - kBoard, 0}, {kToX, y, kShelfDepth}, 0.003f, kBack);
    for (const float x : {kFromX + 0.09f, kToX - 0.09f}) {
      const float under = y - kBoard - 0.006f;
      add_tube(brackets, {{x, under, 0}, {x, under, kShelfDepth - 0.02f}}, 0.006f, 10, false);
      add_tube(brackets, {{x, under - 0.10f, 0.005f}, {x, under, kShelfDepth - 0.04f}}, 0.005f, 10, false,
               false);
      add_box(brackets, {x - 0.012f, under - 0.13f, 0}, {x + 0.012f, under + 0.004f, 0.005f}, 0.0015f, kBack);
    }
  }
  stage.add("boards", "oak", boards);
  stage.add("brackets", "brass", brackets);
}

/// A towel rolled up: windings show as grooves on the ends.
MeshBuilder rolled_towel(float radius, float length) {
  MeshBuilder out;
  std::vector<Vec2> profile;
  constexpr int kWindings = 4;
  const float step = radius / kWindings;
  const auto end = [&](bool far) {
    std::vector<Vec2> points;
    for (int k = 0; k < kWindings; ++k) {
      const float r = step * static_cast<float>(k);
      points.insert(points.end(), {{r, 0.006f}, {r + 0.3f * step, -0.004f}, {r + 0.75f * step, -0.004f}});
    }
    points.emplace_back(radius, 0.008f);
    if (far) {
      for (Vec2& p : points) p.y = length - p.y;
      return std::vector<Vec2>(points.rbegin(), points.rend());
    }
    return points;
  };
  profile = end(false);
  for (const Vec2& p : end(true)) profile.push_back(p);
  add_lathe(out, profile, 24, 70);
  return out;
}

void add_shelf_goods(Stage& stage) {
  const auto roll = [&](const char* name, const char* material, float x, float y, float radius) {
    MeshBuilder placed;
    placed.append(rolled_towel(radius, 0.19f),
                  move({x, y, 0.008f}) * turn(90, {1, 0, 0}) * turn(37 * x * 100, {0, 1, 0}));
    stage.add(name, material, placed);
  };
  constexpr float kRadius = 0.052f;
  roll("rolled towel 1", "teal towel", 0.19f, kLow + kRadius - 0.002f, kRadius);
  roll("rolled towel 2", "linen", 0.295f, kLow + kRadius - 0.002f, kRadius);
  roll("rolled towel 3", "terracotta towel", 0.2425f, kLow + kRadius + 0.089f, kRadius);
  add_vessel(stage, "tall jar", "ceramic", jar(0.048f, 0.13f), {0.46f, kLow, 0.09f});
  add_vessel(stage, "brown bottle", "amber glass", pump_bottle(0.034f, 0.16f), {0.57f, kLow, 0.085f});
  add_vessel(stage, "brown bottle pump", "black steel", pump(0.16f), {0.57f, kLow, 0.085f}, -40);
  add_vessel(stage, "small jar", "clay", jar(0.036f, 0.06f), {0.66f, kLow, 0.10f});
  add_vessel(stage, "vase", "clay", vase(0.055f, 0.21f), {0.22f, kHigh, 0.09f});
  add_vessel(stage, "sage jar", "sage bottle", jar(0.044f, 0.10f), {0.38f, kHigh, 0.085f});
  add_vessel(stage, "cup", "ceramic", cup(0.036f, 0.075f), {0.48f, kHigh, 0.10f});
}

void add_vanity_goods(Stage& stage) {
  constexpr float kTop = 0.83f;
  MeshBuilder tray;
  add_box(tray, {1.83f, kTop, 0.10f}, {2.03f, kTop + 0.012f, 0.24f}, 0.004f, kBottom);
  stage.add("tray", "oak", tray);
  add_vessel(stage, "soap bottle", "amber glass", pump_bottle(0.033f, 0.14f), {1.88f, kTop + 0.012f, 0.165f});
  add_vessel(stage, "soap pump", "brass", pump(0.14f), {1.88f, kTop + 0.012f, 0.165f}, -120);
  add_vessel(stage, "lotion", "ceramic", jar(0.034f, 0.055f), {1.975f, kTop + 0.012f, 0.17f});

  const Vec3 brushes(1.18f, kTop, 0.15f);
  add_vessel(stage, "tooth mug", "clay", cup(0.037f, 0.095f), brushes);
  const auto brush = [&](const char* name, const char* material, Vec3 lean) {
    MeshBuilder stick;
    const Vec3 foot = brushes + Vec3(-0.25f * lean.x, 0.012f, -0.25f * lean.z);
    add_tube(stick, {foot, foot + lean}, 0.0042f, 8);
    add_tube(stick, {foot + 0.86f * lean + Vec3(0, 0, 0.004f), foot + 0.86f * lean + Vec3(0, 0.002f, 0.016f)},
             0.0075f, 8, false);
    stage.add(name, material, stick);
  };
  brush("brush 1", "oak", {-0.045f, 0.18f, 0.012f});
  brush("brush 2", "sage bottle", {0.05f, 0.178f, -0.008f});

  MeshBuilder soap, dish;
  add_lathe(
      dish,
      {{0.045f, 0}, {0.056f, 0.010f}, {0.058f, 0.014f}, {0.054f, 0.014f}, {0.042f, 0.007f}, {0, 0.006f}}, 28,
      40);
  add_vessel(stage, "soap dish", "ceramic", dish, {1.21f, kTop, 0.33f});
  add_box(soap, {-0.034f, 0.006f, -0.022f}, {0.034f, 0.028f, 0.022f}, 0.007f);
  add_vessel(stage, "soap", "soap", soap, {1.21f, kTop, 0.33f}, 24);
}

void add_stool(Stage& stage) {
  const Vec3 at(3.17f, 0, 0.42f);
  constexpr float kSeat = 0.45f;
  MeshBuilder seat, legs, stool;
  add_lathe(seat,
            {{0.0f, kSeat - 0.032f},
             {0.150f, kSeat - 0.032f},
             {0.165f, kSeat - 0.024f},
             {0.170f, kSeat - 0.012f},
             {0.165f, kSeat - 0.002f},
             {0.150f, kSeat},
             {0, kSeat - 0.004f}},
            40, 40);
  for (int k = 0; k < 3; ++k) {
    const float a = 2 * kPi * (static_cast<float>(k) + 0.35f) / 3;
    const Vec3 out(std::cos(a), 0, std::sin(a));
    add_tube(legs, {0.175f * out, 0.11f * out + Vec3(0, kSeat - 0.028f, 0)}, 0.014f, 12, false, false);
  }
  stool.append(seat, move(at));
  stool.append(legs, move(at));
  stage.add("stool", "oak", stool);
  MeshBuilder book, pages;
  add_box(book, {-0.075f, 0, -0.105f}, {0.075f, 0.022f, 0.105f}, 0.0015f);
  add_vessel(stage, "book", "clay", book, at + Vec3(-0.02f, kSeat, 0.01f), 28);
  add_vessel(stage, "bowl", "ceramic", cup(0.05f, 0.055f), at + Vec3(-0.015f, kSeat + 0.022f, 0.01f));
}

}  // namespace

void add_shelves(Stage& stage) {
  add_boards(stage);
  add_shelf_goods(stage);
  add_vanity_goods(stage);
  add_stool(stage);
}

}  // namespace sconce::demo
