// SPDX-License-Identifier: Apache-2.0
// Reeded oak cabinet, stone top, oval basin with its tap, and the mirror above.
#include <vector>

#include "bathroom.h"

namespace sconce::demo {
namespace {

constexpr float kLeftSide = 1.06f, kRightSide = 2.06f, kUnder = 0.42f, kTopY = 0.80f, kFrontZ = 0.47f;
constexpr float kMiddle = 0.5f * (kLeftSide + kRightSide), kSlab = 0.03f;

void add_cabinet(Stage& stage) {
  constexpr float kBoard = 0.022f, kRound = 0.002f, kReed = 0.012f;
  MeshBuilder carcass;
  add_box(carcass, {kLeftSide, kUnder, kTile}, {kLeftSide + kBoard, kTopY, kFrontZ}, kRound, kBack | kTop);
  add_box(carcass, {kRightSide - kBoard, kUnder, kTile}, {kRightSide, kTopY, kFrontZ}, kRound, kBack | kTop);
  add_box(carcass, {kLeftSide + kBoard, kUnder, kTile}, {kRightSide - kBoard, kUnder + kBoard, kFrontZ},
          kRound, kBack | kLeft | kRight);
  stage.add("cabinet", "oak", carcass);

  // Two drawers with half-round reeds.
  MeshBuilder reeds, shadow;
  const float left = kLeftSide + kBoard, right = kRightSide - kBoard;
  constexpr int kReeds = 40, kFacets = 6;
  constexpr float kValley = kFrontZ - 0.014f;
  const auto drawer = [&](float y0, float y1, float end) {
    reeds.part(40);
    const float pitch = (right - left) / kReeds;
    for (int i = 0; i < kReeds; ++i)
      for (int k = 0; k < kFacets; ++k) {
        const auto at = [&](int step, float y) {
          const float t = static_cast<float>(step) / kFacets, x = left + (static_cast<float>(i) + t) * pitch;
          return Corner{{x, y, kValley + kReed * std::sin(kPi * t)}, {x, y}};
        };
        reeds.quad(at(k, y0), at(k + 1, y0), at(k + 1, y1), at(k, y1));
        const auto behind = [&](int step) {
          Corner c = at(step, end);
          c.p.z = kValley;
          return c;
        };
        if (end == y1)
          reeds.quad(at(k, end), at(k + 1, end), behind(k + 1), behind(k));
        else
          reeds.quad(behind(k), behind(k + 1), at(k + 1, end), at(k, end));
      }
  };
  const float bottom = kUnder + kBoard, seam = bottom + 0.5f * (kTopY - bottom);
  constexpr float kGap = 0.002f;
  drawer(bottom, seam - kGap, seam - kGap);
  drawer(seam + kGap, kTopY, seam + kGap);
  stage.add("drawers", "oak", reeds, 2);
  add_rectangle(shadow, {left, seam - kGap, kValley}, {right - left, 0, 0}, {0, 2 * kGap, 0});
  stage.add("drawer seam", "black steel", shadow);

  MeshBuilder knobs, knob;
  add_lathe(
      knob,
      {{0.006f, 0}, {0.006f, 0.012f}, {0.013f, 0.016f}, {0.014f, 0.020f}, {0.011f, 0.025f}, {0, 0.026f}}, 16,
      35);
  for (const float x : {left + 0.27f, right - 0.27f})
    for (const float y : {0.5f * (bottom + seam), 0.5f * (seam + kTopY)})
      knobs.append(knob, move({x, y, kFrontZ - 0.006f}) * turn(90, {1, 0, 0}));
  stage.add("knobs", "brass", knobs);

  MeshBuilder slab;
  add_box(slab, {kLeftSide - 0.015f, kTopY, kTile - 0.003f},
          {kRightSide + 0.015f, kTopY + kSlab, kFrontZ + 0.02f}, 0.004f, kBack);
  stage.add("vanity top", "stone", slab);
}

void add_basin(Stage& stage) {
  constexpr float kY = kTopY + kSlab;
  const Mat4 place = move({kMiddle, kY, 0.26f}) * scale({1.32f, 1, 1});
  MeshBuilder bowl, basin, drain;
  add_lathe(bowl,
            smooth_curve<Vec2>({{0.105f, 0.000f},
                                {0.112f, 0.006f},
                                {0.136f, 0.045f},
                                {0.160f, 0.095f},
                                {0.168f, 0.118f},
                                {0.1695f, 0.125f},
                                {0.167f, 0.129f},
                                {0.163f, 0.128f},
                                {0.160f, 0.122f},
                                {0.150f, 0.092f},
                                {0.126f, 0.048f},
                                {0.090f, 0.026f},
                                {0.040f, 0.019f},
                                {0.016f, 0.018f}},
                               2),
            40, 60);
  basin.append(bowl, place);
  stage.add("basin", "ceramic", basin, 1.5f);
  MeshBuilder cap;
  add_lathe(cap, {{0.022f, 0}, {0.022f, 0.003f}, {0.019f, 0.005f}, {0, 0.005f}}, 20, 35);
  drain.append(cap, move({kMiddle, kY + 0.0175f, 0.26f}));
  stage.add("basin drain", "brass", drain);

  const Vec3 foot(kMiddle, kY, 0.055f);
  MeshBuilder tap, base;
  add_lathe(base, {{0.027f, 0}, {0.027f, 0.006f}, {0.023f, 0.009f}, {0.014f, 0.010f}}, 20, 35);
  tap.append(base, move(foot));
  const auto at = [&](float y, float z) { return foot + Vec3(0, y, z); };
  add_tube(tap,
           smooth_curve<Vec3>({at(0.005f, 0), at(0.12f, 0), at(0.215f, 0.004f), at(0.262f, 0.045f),
                               at(0.262f, 0.105f), at(0.232f, 0.138f), at(0.205f, 0.141f)},
                              5),
           0.0115f, 14, false);
  for (const float side : {-1.0f, 1.0f}) {
    const Vec3 valve = foot + Vec3(0.095f * side, 0, 0);
    tap.append(base, move(valve));
    add_tube(tap, {valve + Vec3(0, 0.005f, 0), valve + Vec3(0, 0.045f, 0)}, 0.013f, 14, false);
    add_tube(tap, {valve + Vec3(-0.026f, 0.054f, 0), valve + Vec3(0.026f, 0.054f, 0)}, 0.0055f, 10);
    add_tube(tap, {valve + Vec3(0, 0.054f, -0.026f), valve + Vec3(0, 0.054f, 0.026f)}, 0.0055f, 10);
    add_tube(tap, {valve + Vec3(0, 0.044f, 0), valve + Vec3(0, 0.060f, 0)}, 0.009f, 12, false);
  }
  stage.add("basin tap", "brass", tap);
}

/// Upright rectangle with half-round ends.
std::vector<Vec2> stadium(float half_width, float half_height) {
  std::vector<Vec2> out;
  constexpr int kSteps = 20;
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k <= kSteps; ++k) {
      const float a = kPi * (static_cast<float>(end) + static_cast<float>(k) / kSteps),
                  rise = half_height - half_width;
      out.emplace_back(half_width * std::cos(a), half_width * std::sin(a) + (end ? -rise : rise));
    }
  return out;
}

void add_mirror(Stage& stage) {
  constexpr float kHalfWidth = 0.30f, kHalfHeight = 0.47f, kRim = 0.014f;
  const Vec3 middle(kMiddle, 1.56f, 0);
  const std::vector<Vec2> inner = stadium(kHalfWidth, kHalfHeight),
                          outer = stadium(kHalfWidth + kRim, kHalfHeight + kRim);
  MeshBuilder frame, glass;
  std::vector<std::vector<Vec3>> rings;
  const auto ring = [&](const std::vector<Vec2>& outline, float z) {
    auto& points = rings.emplace_back();
    for (const Vec2& p : outline) points.push_back(middle + Vec3(p, z));
  };
  const auto between = [&](float t) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < inner.size(); ++k) points.push_back(glm::mix(outer[k], inner[k], t));
    return points;
  };
  ring(outer, 0), ring(outer, 0.026f), ring(between(0.25f), 0.030f), ring(between(0.75f), 0.030f),
      ring(inner, 0.026f), ring(inner, 0.018f);
  add_loft(frame, rings, 50);
  stage.add("mirror frame", "brass", frame);

  glass.part(1);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    const auto at = [&](Vec2 p) {
      return Corner{middle + Vec3(p, 0.018f), p + Vec2(kHalfWidth, kHalfHeight)};
    };
    glass.triangle(at(Vec2(0)), at(inner[k]), at(inner[(k + 1) % inner.size()]));
  }
  stage.add("mirror", "mirror", glass);
}

}  // namespace

void add_vanity(Stage& stage) {
  add_cabinet(stage);
  add_basin(stage);
  add_mirror(stage);
}

}  // namespace sconce::demo
