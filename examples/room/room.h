// SPDX-License-Identifier: Apache-2.0
// The room that the example's renderer shows, as data: so that a test can follow paths in it.
#pragma once

#include <array>
#include <vector>

namespace room {

using Triple = std::array<float, 3>;

struct Paint {
  const char* name;
  Triple color, emission;
};
inline constexpr std::array<Paint, 7> kPaints{{{"floor", {0.45f, 0.36f, 0.28f}, {}},
                                               {"plaster", {0.75f, 0.74f, 0.7f}, {}},
                                               {"red wall", {0.65f, 0.12f, 0.1f}, {}},
                                               {"green wall", {0.14f, 0.5f, 0.16f}, {}},
                                               {"crate", {0.6f, 0.5f, 0.35f}, {}},
                                               {"lacquer", {0.2f, 0.3f, 0.6f}, {}},
                                               {"panel", {0.1f, 0.1f, 0.1f}, {1.2f, 0.9f, 0.5f}}}};

/// What it is painted with while the program runs.
inline constexpr std::size_t kRepainted = 1;
inline constexpr Triple kNewColor{0.2f, 0.45f, 0.7f};

/// A rectangle; its front is the side of cross(a, b).
struct Wall {
  std::size_t paint;
  Triple corner, a, b;
};

/// The five faces of a box that stands on the floor.
inline void add_crate(std::vector<Wall>& walls, std::size_t paint, Triple lo, Triple hi) {
  const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  walls.push_back({paint, {lo[0], hi[1], lo[2]}, {0, 0, z}, {x, 0, 0}});
  walls.push_back({paint, {lo[0], lo[1], hi[2]}, {x, 0, 0}, {0, y, 0}});
  walls.push_back({paint, lo, {0, y, 0}, {x, 0, 0}});
  walls.push_back({paint, lo, {0, 0, z}, {0, y, 0}});
  walls.push_back({paint, {hi[0], lo[1], lo[2]}, {0, y, 0}, {0, 0, z}});
}

inline std::vector<Wall> walls() {
  std::vector<Wall> all{{0, {0, 0, 0}, {0, 0, 4}, {5, 0, 0}},          {1, {0, 3, 0}, {5, 0, 0}, {0, 0, 4}},
                        {1, {0, 0, 0}, {5, 0, 0}, {0, 3, 0}},          {1, {5, 0, 4}, {-5, 0, 0}, {0, 3, 0}},
                        {2, {0, 0, 4}, {0, 0, -4}, {0, 3, 0}},         {3, {5, 0, 0}, {0, 0, 4}, {0, 3, 0}},
                        {6, {2, 1.2f, 0.01f}, {1, 0, 0}, {0, 0.6f, 0}}};
  add_crate(all, 4, {1, 0, 0.8f}, {2.2f, 1.6f, 1.8f});
  add_crate(all, 5, {3, 0, 1.6f}, {3.9f, 0.8f, 2.5f});
  return all;
}

inline constexpr Triple kEye{2.5f, 1.5f, 3.9f}, kTarget{2.5f, 1.2f, 0};
inline constexpr float kFieldOfView = 70;  ///< vertical, degrees
inline constexpr int kWidth = 320, kHeight = 240;

/// The renderer's light model: strength x cosine, divided by the square of the distance over 2 m where
/// `falloff` is 1 and by nothing where it is 0; no shadows.
struct Lamp {
  Triple position{3.8f, 2.2f, 2.2f}, strength{0.5f, 0.46f, 0.4f};
  float falloff = 0;
};

}  // namespace room
