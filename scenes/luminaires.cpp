// SPDX-License-Identifier: Apache-2.0
#include "luminaires.h"

#include <cmath>

#include "stage.h"

namespace sconce::demo {

namespace {

constexpr float kMetre = 1000;  // models are in millimetres

/// A stage for a lamp in millimetres.
class Bench {
 public:
  Bench() {
    stage_.paint("mirror", "f0f0f0");
    stage_.scene.materials.back().metallic = 1;
    stage_.scene.materials.back().roughness = 0;
    stage_.paint("black", "101010");
    stage_.paint("white", "f4f4f4");
  }
  void add(const char* name, const char* material, const MeshBuilder& shape) {
    stage_.add(name, material, shape);
    shrink();
  }
  void add_emitter(const char* name, const MeshBuilder& shape, float lumens) {
    stage_.add_light(name, shape, "lamp", lumens * kMetre * kMetre, 6504);
    shrink();
  }
  Scene finish(const char* name) {
    stage_.scene.name = name;
    return std::move(stage_.scene);
  }

 private:
  void shrink() {
    for (Vec3& p : stage_.scene.meshes.back().positions) p /= kMetre;
  }

  Stage stage_;
};

}  // namespace

Scene make_torch() {
  constexpr float kRadius = 10, kFocus = 2.5f, kNeck = 1.5f, kDepth = kRadius * kRadius / (4 * kFocus);
  constexpr float kBefore = 0.35f;  // of the filament: a ring with a dark middle
  Bench bench;
  std::vector<Vec2> profile;  // top to bottom faces inward
  for (int i = 0; i <= 48; ++i) {
    const float r = kNeck + (kRadius - kNeck) * static_cast<float>(i) / 48;
    profile.emplace_back(r, kDepth - r * r / (4 * kFocus));
  }
  MeshBuilder reflector, socket, filament;
  add_lathe(reflector, profile, 96, 60);
  bench.add("reflector", "mirror", reflector);
  socket.part(1);
  const float top = kDepth - kNeck * kNeck / (4 * kFocus);
  add_rectangle(socket, Vec3(-2, top, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
  bench.add("socket", "black", socket);
  const float at = kDepth - kFocus - kBefore;
  add_box(filament, Vec3(-0.9f, at - 0.15f, -0.15f), Vec3(0.9f, at + 0.15f, 0.15f), 0);
  bench.add_emitter("filament", filament, 30);
  return bench.finish("torch");
}

Scene make_bicycle_light() {
  constexpr float kWidth = 42, kHeight = 28, kFocus = 10;
  constexpr float kFlute = 3.5f, kRipple = 0.03f;  // ribs across the beam spread it by some 6 degrees
  constexpr float kDepth = (kWidth * kWidth / 4 + kHeight * kHeight) / (4 * kFocus);
  const auto surface = [&](float x, float up) {
    return kDepth - (x * x + up * up) / (4 * kFocus) + kRipple * std::cos(2 * kPi * x / kFlute);
  };
  Bench bench;
  MeshBuilder reflector, plate, led, sides;
  add_sheet(
      reflector, 240, 48,
      [&](float u, float v) {
        const float x = (0.5f - u) * kWidth, up = v * kHeight;
        return Vec3(x, surface(x, up), 0.5f * kHeight - up);
      },
      Vec2(kWidth, kHeight), 60);
  bench.add("reflector", "mirror", reflector);
  plate.part(1);  // under the reflector, from its apex to the opening
  add_rectangle(plate, Vec3(-0.5f * kWidth, 0, 0.5f * kHeight), Vec3(0, kDepth + 1, 0), Vec3(kWidth, 0, 0));
  bench.add("plate", "black", plate);
  sides.part(1);
  add_rectangle(sides, Vec3(-0.5f * kWidth, 0, -0.5f * kHeight), Vec3(0, kDepth, 0), Vec3(0, 0, kHeight));
  add_rectangle(sides, Vec3(0.5f * kWidth, 0, -0.5f * kHeight), Vec3(0, 0, kHeight), Vec3(0, kDepth, 0));
  add_rectangle(sides, Vec3(-0.5f * kWidth, 0, -0.5f * kHeight), Vec3(kWidth, 0, 0), Vec3(0, kDepth, 0));
  bench.add("sides", "black", sides);
  led.part(1);
  const float at = kDepth - kFocus;
  add_rectangle(led, Vec3(-0.75f, at - 0.75f, 0.5f * kHeight - 0.1f), Vec3(0, 1.5f, 0), Vec3(1.5f, 0, 0));
  bench.add_emitter("led", led, 60);
  return bench.finish("bicycle_light");
}

Scene make_louvre() {
  constexpr float kHalf = 80, kTop = 60, kFin = 40, kThick = 1.5f;
  constexpr int kCells = 4;
  Bench bench;
  MeshBuilder panel, walls, fins;
  panel.part(1), walls.part(1);
  add_rectangle(panel, Vec3(-kHalf, kTop, -kHalf), Vec3(2 * kHalf, 0, 0), Vec3(0, 0, 2 * kHalf));
  bench.add_emitter("panel", panel, 1200);
  const Vec3 y(0, kTop, 0), x(2 * kHalf, 0, 0), z(0, 0, 2 * kHalf), corner(-kHalf, 0, -kHalf);
  add_rectangle(walls, corner, x, y), add_rectangle(walls, corner + z, y, x);
  add_rectangle(walls, corner, y, z), add_rectangle(walls, corner + x, z, y);
  bench.add("walls", "white", walls);
  for (int i = 1; i < kCells; ++i) {
    const float at = -kHalf + 2 * kHalf * static_cast<float>(i) / kCells, half = 0.5f * kThick;
    add_box(fins, Vec3(at - half, 0, -kHalf), Vec3(at + half, kFin, kHalf), 0);
    add_box(fins, Vec3(-kHalf, 0, at - half), Vec3(kHalf, kFin, at + half), 0);
  }
  bench.add("louvre", "mirror", fins);
  return bench.finish("louvre");
}

Scene make_washer() {
  constexpr float kHalf = 59, kDepth = 20, kLed = 2;
  constexpr int kLeds = 6;
  Bench bench;
  MeshBuilder mirror, trough, leds;
  // The mirror leans outwards from beside the LEDs.
  mirror.part(1), trough.part(1), leds.part(1);
  const Vec3 foot(-kHalf, kDepth, 2), along(2 * kHalf, 0, 0);
  add_rectangle(mirror, foot, along, Vec3(0, -kDepth, 12));
  bench.add("side", "mirror", mirror);
  add_rectangle(trough, Vec3(-kHalf, 0, -14), along, Vec3(0, kDepth, 0));
  add_rectangle(trough, Vec3(-kHalf, kDepth, -14), along, Vec3(0, 0, 16));
  add_rectangle(trough, Vec3(-kHalf, 0, -14), Vec3(0, kDepth, 0), Vec3(0, 0, 28));
  add_rectangle(trough, Vec3(kHalf, 0, -14), Vec3(0, 0, 28), Vec3(0, kDepth, 0));
  bench.add("trough", "white", trough);
  for (int i = 0; i < kLeds; ++i) {
    const float x = kHalf * (static_cast<float>(2 * i + 1) / kLeds - 1);
    add_rectangle(leds, Vec3(x - kLed / 2, kDepth - 0.1f, -2), Vec3(kLed, 0, 0), Vec3(0, 0, kLed));
  }
  bench.add_emitter("leds", leds, 300);
  return bench.finish("washer");
}

}  // namespace sconce::demo
