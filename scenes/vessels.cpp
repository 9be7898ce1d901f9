// SPDX-License-Identifier: Apache-2.0
#include "vessels.h"

namespace sconce::demo {
namespace {

constexpr int kSegments = 20;
constexpr float kCrease = 40;

}  // namespace

MeshBuilder pump_bottle(float r, float h) {
  MeshBuilder out;
  const float neck = 0.42f * r, body = h - 1.1f * r;
  add_lathe(out,
            {{r - 0.002f, 0},
             {r, 0.003f},
             {r, body},
             {0.92f * r, body + 0.35f * r},
             {0.70f * r, body + 0.62f * r},
             {neck, body + 0.75f * r},
             {neck, h},
             {0, h}},
            kSegments, kCrease);
  return out;
}

MeshBuilder pump(float h) {
  MeshBuilder out;
  add_lathe(out,
            {{0.014f, h - 0.012f},
             {0.0145f, h + 0.006f},
             {0.010f, h + 0.010f},
             {0.004f, h + 0.011f},
             {0.004f, h + 0.028f},
             {0.009f, h + 0.029f},
             {0.009f, h + 0.036f},
             {0, h + 0.038f}},
            14, 35);
  add_tube(out, {{0, h + 0.033f, 0}, {0.030f, h + 0.033f, 0}, {0.040f, h + 0.028f, 0}}, 0.0035f, 8, false);
  return out;
}

MeshBuilder jar(float r, float h) {
  MeshBuilder out;
  const float lid = 0.26f * h;
  add_lathe(out,
            {{r - 0.003f, 0},
             {r, 0.004f},
             {r, h - lid},
             {r - 0.003f, h - lid},
             {r - 0.003f, h - lid + 0.003f},
             {r + 0.001f, h - lid + 0.003f},
             {r + 0.001f, h - 0.004f},
             {r - 0.003f, h},
             {0.010f, h + 0.001f},
             {0.006f, h + 0.006f},
             {0.011f, h + 0.014f},
             {0.008f, h + 0.02f},
             {0, h + 0.021f}},
            kSegments, kCrease);
  return out;
}

MeshBuilder cup(float r, float h) {
  MeshBuilder out;
  add_lathe(out,
            {{0.90f * r, 0},
             {0.94f * r, 0.004f},
             {r, h - 0.001f},
             {r - 0.001f, h},
             {r - 0.004f, h},
             {r - 0.005f, h - 0.001f},
             {0.9f * r - 0.004f, 0.006f},
             {0, 0.006f}},
            kSegments, kCrease);
  return out;
}

MeshBuilder vase(float r, float h) {
  MeshBuilder out;
  add_lathe(out,
            smooth_curve<Vec2>({{0.55f * r, 0},
                                {0.60f * r, 0.02f * h},
                                {0.93f * r, 0.16f * h},
                                {r, 0.32f * h},
                                {0.86f * r, 0.48f * h},
                                {0.46f * r, 0.64f * h},
                                {0.26f * r, 0.78f * h},
                                {0.25f * r, 0.92f * h},
                                {0.33f * r, h},
                                {0.26f * r, 0.985f * h},
                                {0.18f * r, 0.92f * h},
                                {0.0f, 0.80f * h}},
                               2),
            24, 60);
  return out;
}

void add_vessel(Stage& stage, const char* name, const char* material, const MeshBuilder& shape, Vec3 at,
                float turn_degrees) {
  MeshBuilder placed;
  placed.append(shape, move(at) * turn(turn_degrees, {0, 1, 0}));
  stage.add(name, material, placed);
}

}  // namespace sconce::demo
