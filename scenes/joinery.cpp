// SPDX-License-Identifier: Apache-2.0
// Window, door, skirting boards and the metal and stone edges of the tiled parts.
#include "bathroom.h"

namespace sconce::demo {
namespace {

void add_window(Stage& stage) {
  const Vec3 lo = kWindowLo, hi = kWindowHi;
  constexpr float kBar = 0.05f, kOut = -0.115f, kIn = -0.07f, kEdge = 0.004f;
  // Bars that cross have different depths, so that no two faces lie in one plane.
  MeshBuilder frame;
  const auto bar = [&](float y0, float y1, float z0, float z1, float thinner, unsigned open) {
    add_box(frame, {kOut + thinner, y0, z0}, {kIn - thinner, y1, z1}, kEdge, open);
  };
  bar(lo.y, hi.y, lo.z, lo.z + kBar, 0, kBottom | kTop | kBack);
  bar(lo.y, hi.y, hi.z - kBar, hi.z, 0, kBottom | kTop | kFront);
  bar(lo.y, lo.y + 0.07f, lo.z + kBar, hi.z - kBar, 0.003f, kBack | kFront | kBottom);
  bar(hi.y - kBar, hi.y, lo.z + kBar, hi.z - kBar, 0.003f, kBack | kFront | kTop);
  const float middle = 0.5f * (lo.z + hi.z), transom = lo.y + 0.74f;
  bar(lo.y + 0.07f, hi.y - kBar, middle - 0.022f, middle + 0.022f, 0.006f, kBottom | kTop);
  bar(transom, transom + 0.03f, lo.z + kBar, middle - 0.022f, 0.009f, kBack | kFront);
  bar(transom, transom + 0.03f, middle + 0.022f, hi.z - kBar, 0.009f, kBack | kFront);
  stage.add("window frame", "black steel", frame);

  MeshBuilder handle;
  add_box(handle, {kIn - 0.008f, lo.y + 0.40f, middle - 0.011f},
          {kIn + 0.002f, lo.y + 0.47f, middle + 0.011f}, 0.003f, kLeft);
  add_tube(handle, {{kIn, lo.y + 0.435f, middle}, {kIn + 0.035f, lo.y + 0.435f, middle}}, 0.006f, 10, false);
  add_tube(handle, {{kIn + 0.03f, lo.y + 0.44f, middle}, {kIn + 0.03f, lo.y + 0.33f, middle}}, 0.007f, 10);
  stage.add("window handle", "brass", handle);

  MeshBuilder sill;
  add_box(sill, {kIn - 0.02f, lo.y - 0.003f, lo.z}, {0.05f, lo.y + 0.025f, hi.z}, 0.005f, kLeft);
  stage.add("window sill", "stone", sill);
}

void add_door(Stage& stage) {
  constexpr float kFace = kDepth + kDoorReveal;
  MeshBuilder leaf, casing, handle;
  add_rectangle(leaf, {kDoorRight, 0, kFace}, {kDoorLeft - kDoorRight, 0, 0}, {0, kDoorHeight, 0});
  const auto panel = [&](float y0, float y1) {
    add_box(leaf, {kDoorLeft + 0.12f, y0, kFace - 0.014f}, {kDoorRight - 0.12f, y1, kFace}, 0.012f, kFront);
  };
  panel(0.16f, 0.92f);
  panel(1.08f, 1.98f);
  stage.add("door", "joinery", leaf);

  constexpr float kBoard = 0.07f, kThick = 0.016f;
  add_box(casing, {kDoorLeft - kBoard, 0, kDepth - kThick}, {kDoorLeft, kDoorHeight, kDepth}, 0.003f,
          kFront | kBottom | kTop);
  add_box(casing, {kDoorRight, 0, kDepth - kThick}, {kDoorRight + kBoard, kDoorHeight, kDepth}, 0.003f,
          kFront | kBottom | kTop);
  add_box(casing, {kDoorLeft - kBoard, kDoorHeight, kDepth - kThick},
          {kDoorRight + kBoard, kDoorHeight + kBoard, kDepth}, 0.003f, kFront);
  stage.add("door casing", "joinery", casing);

  const Vec3 at(kDoorRight - 0.06f, 1.03f, kFace);
  add_box(handle, at + Vec3(-0.02f, -0.09f, -0.008f), at + Vec3(0.02f, 0.09f, 0), 0.003f, kFront);
  add_tube(
      handle,
      smooth_curve<Vec3>(
          {at, at + Vec3(0, 0, -0.035f), at + Vec3(-0.02f, 0, -0.055f), at + Vec3(-0.12f, 0, -0.055f)}, 4),
      0.008f, 10, false);
  stage.add("door handle", "black steel", handle);
}

void add_edges(Stage& stage) {
  MeshBuilder skirting, cap, brass;
  constexpr float kTall = 0.08f, kThick = 0.013f, kRound = 0.004f;
  const auto board = [&](Vec3 lo, Vec3 hi, unsigned open) {
    add_box(skirting, lo, hi, kRound, open | kBottom);
  };
  board({kDadoRight + 0.006f, 0, 0}, {kAlcoveLeft - 0.008f, kTall, kThick}, kBack | kLeft);
  board({kWidth - kThick, 0, 0.006f}, {kWidth, kTall, kDepth}, kRight | kFront);
  board({kDoorRight + 0.07f, 0, kDepth - kThick}, {kWidth, kTall, kDepth}, kFront | kLeft | kRight);
  board({0, 0, kDepth - kThick}, {kDoorLeft - 0.07f, kTall, kDepth}, kFront | kLeft | kRight);
  stage.add("skirting", "joinery", skirting);

  constexpr float kCap = 0.02f, kOut = 0.018f;
  add_box(cap, {0, kDado, 0}, {kOut, kDado + kCap, kDepth}, kRound, kLeft | kBack | kFront);
  add_box(cap, {kOut, kDado, 0}, {kDadoRight + 0.006f, kDado + kCap, kOut}, kRound, kBack | kLeft);
  stage.add("dado cap", "stone", cap);

  add_box(brass, {kDadoRight, 0, 0}, {kDadoRight + 0.006f, kDado, kTile + 0.003f}, 0, kBack | kBottom | kTop);
  add_box(brass, {kAlcoveLeft - 0.008f, 0, -0.014f}, {kAlcoveLeft + kTile + 0.003f, kAlcoveHeight, 0.004f},
          0.002f, kBottom | kTop);
  add_box(brass, {kWidth - kTile - 0.003f, 0, -0.006f}, {kWidth, kAlcoveHeight, 0.006f}, 0.002f,
          kBottom | kTop | kRight);
  add_box(brass, {kAlcoveLeft + 0.011f, 0, -0.010f}, {kWidth - 0.011f, 0.008f, 0.008f}, 0.002f,
          kBottom | kLeft | kRight);
  stage.add("brass edges", "brass", brass);
}

}  // namespace

void add_joinery(Stage& stage) {
  add_window(stage);
  add_door(stage);
  add_edges(stage);
}

}  // namespace sconce::demo
