// SPDX-License-Identifier: Apache-2.0
// A free-standing tub, lofted from superellipses, with a standing tap and a towel over its rim.
#include <vector>

#include "bathroom.h"

namespace sconce::demo {
namespace {

constexpr Vec3 kTub{0.56f, 0, 1.10f};
constexpr float kTubHalfLength = 0.80f, kRoundness = 2.5f;

/// (half length, half width, height): from the foot up the outside, over the rim, down the inside to the
/// bottom.
std::vector<Vec3> tub_profile() {
  const std::vector<Vec3> control{
      {0.585f, 0.255f, 0.000f}, {0.605f, 0.268f, 0.010f}, {0.665f, 0.300f, 0.120f}, {0.728f, 0.333f, 0.300f},
      {0.770f, 0.356f, 0.480f}, {0.785f, 0.364f, 0.548f}, {0.797f, 0.376f, 0.562f}, {0.800f, 0.380f, 0.573f},
      {0.797f, 0.377f, 0.583f}, {0.785f, 0.366f, 0.587f}, {0.770f, 0.351f, 0.584f}, {0.762f, 0.343f, 0.572f},
      {0.748f, 0.332f, 0.520f}, {0.700f, 0.305f, 0.340f}, {0.640f, 0.270f, 0.200f}, {0.560f, 0.215f, 0.135f},
      {0.430f, 0.140f, 0.112f}, {0.200f, 0.065f, 0.106f}, {0.026f, 0.026f, 0.104f}};
  return smooth_curve(control, 2);
}

/// The rim rises towards both ends, as a slipper tub's does.
float lift(float along, float y) {
  const float end = std::abs(along) / kTubHalfLength, height = y / 0.587f;
  return 0.085f * end * end * end * height * height;
}

void add_body(Stage& stage) {
  constexpr int kSegments = 64;
  std::vector<std::vector<Vec3>> rings;
  for (const Vec3& level : tub_profile()) {
    auto& ring = rings.emplace_back();
    for (int k = 0; k < kSegments; ++k) {
      const float a = 2 * kPi * (static_cast<float>(k) + 0.5f) / kSegments;
      const auto power = [](float v) { return std::copysign(std::pow(std::abs(v), 2 / kRoundness), v); };
      const float z = -level.x * power(std::sin(a));
      ring.push_back(kTub + Vec3(level.y * power(std::cos(a)), level.z + lift(z, level.z), z));
    }
  }
  MeshBuilder body, drain;
  add_loft(body, rings, 60);
  stage.add("tub", "enamel", body);
  MeshBuilder cap;
  add_lathe(cap, {{0.034f, 0}, {0.034f, 0.003f}, {0.030f, 0.006f}, {0, 0.007f}}, 24, 40);
  drain.append(cap, move(kTub + Vec3(0, 0.103f, 0)));
  stage.add("tub drain", "brass", drain);
}

/// Floor-standing tap at the corner of the tub that is next to the vanity.
void add_tap(Stage& stage) {
  const Vec3 foot(0.985f, 0, 0.36f);
  // Away from the tub (x > 0) and across.
  const Vec3 away(0.7f, 0, -0.714f), across(0.714f, 0, 0.7f);
  const auto up = [&](float x, float y) { return foot + x * away + Vec3(0, y, 0); };
  MeshBuilder tap, base;
  add_lathe(base, {{0.045f, 0}, {0.045f, 0.008f}, {0.040f, 0.013f}, {0.015f, 0.014f}}, 24, 35);
  tap.append(base, move(foot));
  add_tube(tap,
           smooth_curve<Vec3>({up(0, 0.01f), up(0, 0.5f), up(0, 0.86f), up(-0.03f, 0.95f), up(-0.12f, 0.985f),
                               up(-0.22f, 0.96f), up(-0.25f, 0.89f), up(-0.25f, 0.86f)},
                              5),
           0.015f, 14, false);
  add_tube(tap, {up(0.032f, 0.70f), up(-0.036f, 0.70f)}, 0.026f, 16);
  add_tube(tap, {up(0.03f, 0.70f), up(0.058f, 0.70f)}, 0.016f, 14, false);
  add_tube(tap, {up(0.052f, 0.70f), up(0.052f, 0.78f)}, 0.006f, 10);
  add_tube(tap, {up(0, 0.70f) + 0.02f * across, up(0, 0.70f) + 0.055f * across}, 0.010f, 10, false);
  // Hand shower in its cradle, hose hanging in a loop.
  const Vec3 cradle = up(0, 0.70f) + 0.055f * across;
  add_tube(tap,
           {cradle + Vec3(0, -0.07f, -0.005f), cradle + Vec3(0, 0.02f, 0.002f),
            cradle + Vec3(-0.005f, 0.15f, 0.015f)},
           0.011f, 12);
  add_tube(tap,
           smooth_curve<Vec3>({cradle + Vec3(0, -0.068f, -0.004f), cradle + Vec3(0.004f, -0.22f, 0.01f),
                               cradle + Vec3(0.03f, -0.42f, 0.02f), cradle + Vec3(0.07f, -0.36f, 0.0f),
                               cradle + Vec3(0.05f, -0.16f, -0.04f), up(0, 0.67f) + Vec3(0.005f, 0, 0)},
                              6),
           0.005f, 8, false, false);
  stage.add("tub tap", "brass", tap);
}

/// Hangs inside the tub, lies on the rim and falls down on the outside, a little off the enamel all the way.
void add_rim_towel(Stage& stage) {
  constexpr float kOff = 0.007f, kInside = 0.34f, kOutside = 0.20f, kFrom = -0.16f, kWide = 0.42f;
  std::vector<Vec3> path;  // (half length, half width, height) as in the profile, inside to outside
  const std::vector<Vec3> profile = tub_profile();
  Vec3 outermost(0);
  for (auto p = profile.rbegin(); p != profile.rend() && outermost.y < 0.3799f; ++p)
    if (p->z >= kInside) path.push_back(*p), outermost = *p;
  for (float y = outermost.z - 0.03f; y > kOutside; y -= 0.03f)
    path.emplace_back(outermost.x, outermost.y, y);
  const auto at = [&](float u, float v) {
    const float where = v * static_cast<float>(path.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(where), path.size() - 2);
    const Vec3 a = path[i], b = path[i + 1], p = glm::mix(a, b, where - static_cast<float>(i));
    const float z = kFrom + kWide * u;
    const float bulge = std::pow(1 - std::pow(std::abs(z) / p.x, kRoundness), 1 / kRoundness);
    const Vec2 along = glm::normalize(Vec2(b.y - a.y, b.z - a.z));
    const bool outside = p.y >= outermost.y - 1e-4f && p.z < outermost.z;
    const float fall = outside ? std::min(1.0f, (outermost.z - p.z) / 0.25f) : 0.0f;
    const float fold =
        fall * 0.016f * (1 + std::sin(17 * u + 0.6f + 0.8f * fall)) + fall * 0.006f * (1 + std::sin(41 * u));
    const Vec2 off = Vec2(-along.y, along.x) * kOff + Vec2(fold, 0);
    const float slant = 0.018f * (u - 0.5f) * fall;
    return kTub + Vec3(p.y * bulge + off.x, p.z + lift(z, p.z) + off.y + slant, z);
  };
  MeshBuilder towel;
  add_sheet(towel, 36, static_cast<int>(path.size()) - 1, at, {1, 1});
  stage.add("towel on the tub", "terracotta towel", towel);
}

}  // namespace

void add_tub(Stage& stage) {
  add_body(stage);
  add_tap(stage);
  add_rim_towel(stage);
}

}  // namespace sconce::demo
