// SPDX-License-Identifier: Apache-2.0
// Lamps that are things: twelve groups. Their colours, where they are not white, stand in theatre.toml.
#include "theatre.h"

namespace sconce::demo {
namespace {

constexpr double kTungsten = 2700, kHalogen = 3000, kNeutral = 4000, kWhite = 6504;

/// A lampshade, closed, that shines all over; its foot at y = 0.
MeshBuilder shade(float low, float high, float tall) {
  MeshBuilder out;
  add_lathe(out, {{0, 0}, {low, 0}, {high, tall}, {0, tall}}, 24, 40);
  return out;
}

void add_one(Stage& stage, const std::string& name, const MeshBuilder& shape, const Mat4& place,
             const char* group, float lumens, double kelvin) {
  MeshBuilder placed;
  placed.append(shape, place);
  stage.add_light(name, placed, group, lumens, kelvin);
}

void add_house_lights(Stage& stage) {
  MeshBuilder disk, ring, rings;
  add_disk(disk, 0.13f, 24);
  add_lathe(ring, {{0.13f, -0.03f}, {0.155f, -0.03f}, {0.16f, 0}}, 24, 40);
  int count = 0;
  for (const float z : {2.3f, 4.5f, 6.7f, 8.9f})
    for (const float x : {-4.2f, 0.0f, 4.2f}) {
      if (x == 0 && z < 4) continue;  // the chandelier's
      const Vec3 at(x, kHouseHeight, z);
      add_one(stage, "house light " + std::to_string(++count), disk,
              move(at + Vec3(0, -0.03f, 0)) * turn(180, {1, 0, 0}), "house lights", 900, kHalogen);
      rings.append(ring, move(at));
    }
  stage.add("house light rings", "gilding", rings);
}

void add_chandelier(Stage& stage) {
  constexpr float kRadius = 0.8f;
  const Vec3 at(0, 5.9f, 3.3f);
  MeshBuilder brass;
  std::vector<Vec3> hoop;
  for (int k = 0; k <= 36; ++k) {
    const float a = 2 * kPi * static_cast<float>(k) / 36;
    hoop.push_back(at + Vec3(kRadius * std::cos(a), 0, kRadius * std::sin(a)));
  }
  add_tube(brass, hoop, 0.028f, 8, false, false);
  for (int k = 0; k < 12; ++k) {
    const float a = 2 * kPi * static_cast<float>(k) / 12;
    const Vec3 foot = at + Vec3(kRadius * std::cos(a), 0.02f, kRadius * std::sin(a));
    add_tube(brass, {foot, foot + Vec3(0, 0.10f, 0)}, 0.02f, 8, false, false);
    if (k % 3 == 0) add_tube(brass, {foot, at + Vec3(0, 1.0f, 0)}, 0.01f, 6, false, false);
    add_one(stage, "candle " + std::to_string(k + 1), shade(0.055f, 0.04f, 0.13f),
            move(foot + Vec3(0, 0.09f, 0)), "chandelier", 260, kTungsten);
  }
  add_tube(brass, {at + Vec3(0, 1.0f, 0), {at.x, kHouseHeight, at.z}}, 0.016f, 8, false, false);
  stage.add("chandelier", "gilding", brass);
}

void add_sconces(Stage& stage) {
  MeshBuilder brass, arm, plate;
  add_lathe(plate, {{0.085f, 0}, {0.08f, 0.012f}, {0.03f, 0.02f}, {0, 0.022f}}, 20, 40);
  arm.append(plate, turn(-90, {0, 0, 1}) * scale({1.6f, 1, 1}));
  add_tube(arm,
           smooth_curve<Vec3>({{0.02f, 0, 0}, {0.08f, -0.05f, 0}, {0.15f, -0.03f, 0}, {0.16f, 0.04f, 0}}, 4),
           0.012f, 8);
  int count = 0;
  // Between the fields of the panelling; the left wall has one more, where the right has the door.
  for (const float z : {2.8f, 5.5f, 8.2f})
    for (const float side : {-1.0f, 1.0f}) {
      const float at_z = side < 0 ? z : z < 3 ? 1.2f : z == 5.5f ? 6.1f : 8.55f;
      const Mat4 place = move({side * kHouseHalf, 3.1f, at_z}) * scale({-side, 1, 1});
      brass.append(arm, place);
      add_one(stage, "sconce " + std::to_string(++count), shade(0.09f, 0.065f, 0.17f),
              place * move({0.16f, 0.04f, 0}), "sconces", 420, kTungsten);
    }
  stage.add("sconce arms", "gilding", brass);
}

void add_way_out(Stage& stage) {
  MeshBuilder panel, sign, letters;
  // The foyer is a bright panel at the end of the passage.
  add_rectangle(panel, {0, 0, 0}, {0, 0, 1.6f}, {0, 2.3f, 0});
  add_one(stage, "foyer", panel, move({kHouseHalf + 0.35f, 0, 1.9f}), "foyer", 1500, kHalogen);
  const float x = kHouseHalf - 0.07f, y = 2.62f, z = 2.38f;
  add_box(sign, {x, y, z}, {kHouseHalf, y + 0.24f, z + 0.64f}, 0, kRight);
  stage.add_light("exit sign", sign, "exit", 22, kWhite, 0.3f);
  const auto stroke = [&](float a0, float a1, float b0, float b1) {
    // Letters are read from the house: to the right is towards the stage's opposite, +z.
    add_box(letters, {x - 0.012f, y + 0.05f + b0, z + 0.07f + a0}, {x, y + 0.05f + b1, z + 0.07f + a1}, 0,
            kRight);
  };
  constexpr float kT = 0.024f, kTall = 0.14f, kWide = 0.10f;
  stroke(0, kT, 0, kTall), stroke(kT, kWide, 0, kT), stroke(kT, kWide, kTall - kT, kTall),
      stroke(kT, kWide - 0.02f, 0.058f, 0.082f);
  for (const float slope : {-1.0f, 1.0f}) {
    MeshBuilder bar;
    add_box(bar, {-0.012f, -0.084f, -0.013f}, {0, 0.084f, 0.013f}, 0, kRight);
    letters.append(bar, move({x, y + 0.12f, z + 0.265f}) * turn(slope * 34, {1, 0, 0}));
  }
  stroke(0.36f, 0.36f + kT, 0, kTall);
  stroke(0.42f, 0.52f, kTall - kT, kTall), stroke(0.458f, 0.482f, 0, kTall - kT);
  stage.add("exit letters", "sky cloth", letters);
}

void add_footlights(Stage& stage) {
  MeshBuilder hoods;
  for (int k = 0; k < 13; ++k) {
    const float x = -4.5f + 0.75f * static_cast<float>(k), z = apron_edge(x) - 0.16f;
    const float slope = 2 * (kApron - 0.35f) * x / (5.6f * 5.6f);
    const Mat4 place = move({x, kFloor, z}) * turn(std::atan(slope) * 180 / kPi * 1.0f, {0, 1, 0});
    MeshBuilder hood, glass;
    std::vector<std::vector<Vec3>> rings;
    constexpr int kSteps = 10;
    for (const float half : {0.2f, -0.2f}) {
      std::vector<Vec3> ring;
      // A quarter of a tube that is open towards the stage, outside and inside.
      for (int i = 0; i <= kSteps; ++i) {
        const float a = 0.5f * kPi * static_cast<float>(i) / kSteps;
        ring.emplace_back(half, 0.14f * std::sin(a), 0.14f * std::cos(a) - 0.04f);
      }
      for (int i = kSteps; i >= 0; --i) {
        const float a = 0.5f * kPi * static_cast<float>(i) / kSteps;
        ring.emplace_back(half, 0.125f * std::sin(a), 0.125f * std::cos(a) - 0.04f);
      }
      rings.push_back(ring);
    }
    add_loft(hood, rings, 40);
    hoods.append(hood, place);
    add_rectangle(glass, {0.18f, 0.012f, 0.06f}, {-0.36f, 0, 0}, {0, 0.07f, 0.022f});
    add_one(stage, "footlight " + std::to_string(k + 1), glass, place, "footlights", 170, kTungsten);
  }
  stage.add("footlight hoods", "iron", hoods);
}

void add_practicals(Stage& stage) {
  MeshBuilder stand, wire, window, placed;
  const Vec3 lamp(-2.35f, kFloor, -2.95f), table(1.25f, kFloor, -2.45f);
  add_lathe(stand, {{0.16f, 0}, {0.16f, 0.02f}, {0.03f, 0.04f}, {0.013f, 0.06f}, {0.013f, 1.36f}, {0, 1.36f}},
            20, 40);
  placed.append(stand, move(lamp));
  stage.add("lamp stand", "gilding", placed);
  add_one(stage, "floor lamp", shade(0.22f, 0.13f, 0.27f), move(lamp + Vec3(0, 1.3f, 0)), "floor lamp", 650,
          kTungsten);
  add_tube(wire, {table + Vec3(0, 2.05f, 0), {table.x, kFlyHeight, table.z}}, 0.007f, 6, false, false);
  stage.add("pendant wire", "iron", wire);
  add_one(stage, "pendant", shade(0.24f, 0.09f, 0.19f), move(table + Vec3(0, 1.88f, 0)), "pendant", 700,
          kTungsten);
  add_rectangle(window, {0.75f, 0.98f, -0.06f}, {1.1f, 0, 0}, {0, 1.4f, 0});
  add_one(stage, "window glow", window, move({-3.6f, kFloor, -2.6f}) * turn(51.34f, {0, 1, 0}), "window", 800,
          kWhite);
}

void add_sky_lights(Stage& stage) {
  MeshBuilder high, low, moon, trough;
  // The strip above looks down and back at the cloth; the one behind the hills up at it.
  add_rectangle(high, {5.6f, 7.1f, -6.9f}, {-11.2f, 0, 0}, {0, -0.10f, -0.17f});
  stage.add_light("sky batten", high, "sky wash", 11000, kNeutral);
  add_rectangle(low, {5.6f, kFloor + 0.12f, -7.42f}, {-11.2f, 0, 0}, {0, 0.06f, 0.05f});
  add_box(trough, {-5.7f, kFloor, -7.43f}, {5.7f, kFloor + 0.1f, -7.35f}, 0, kBottom);
  stage.add("horizon trough", "iron", trough);
  stage.add_light("horizon batten", low, "horizon", 5000, kHalogen);
  add_disk(moon, 0.42f, 40);
  add_one(stage, "moon", moon, move({2.35f, 4.75f, -7.86f}) * turn(90, {1, 0, 0}), "moon", 60, kNeutral);
}

}  // namespace

void add_theatre_lamps(Stage& stage) {
  add_house_lights(stage);
  add_chandelier(stage);
  add_sconces(stage);
  add_way_out(stage);
  add_footlights(stage);
  add_practicals(stage);
  add_sky_lights(stage);
}

}  // namespace sconce::demo
