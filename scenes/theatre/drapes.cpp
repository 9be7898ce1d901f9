// SPDX-License-Identifier: Apache-2.0
// Cloth: the curtain, tied back, with its valance, and the black legs and borders that hide the wings.
#include "theatre.h"

namespace sconce::demo {
namespace {

float smooth(float from, float to, float t) {
  t = std::clamp((t - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// The left half of the curtain; the cord holds it to the side at a third of its height.
void add_curtain(Stage& stage) {
  constexpr float kTop = kArchHeight + 0.3f, kOuter = -kArchHalf - 0.35f, kTie = 2.75f, kZ = -0.85f;
  const auto inner = [](float y) {
    const float above = smooth(kTie, kTop, y);
    return y > kTie ? -3.72f + 1.75f * above * above : -3.72f + 0.34f * smooth(kTie, kFloor, y);
  };
  const auto at = [&](float u, float v) {
    const float y = glm::mix(kFloor + 0.02f, kTop, v);
    const float tied = std::exp(-std::pow((y - kTie) / 0.4f, 2.0f));
    const float deep = 0.10f * (1 - 0.55f * tied), phase = 2 * kPi * 9 * u;
    const float x = glm::mix(kOuter, inner(y), u) + 0.025f * std::sin(2 * phase);
    return Vec3(x, y, kZ + deep * std::cos(phase) + 0.12f * tied + 0.02f * std::sin(3.1f * y + 5 * u));
  };
  MeshBuilder sheet, half, both, cord, cords;
  add_sheet(sheet, 108, 30, at, {3, 5.4f}, 75);
  half.append(sheet, Mat4(1));
  both.append(half, Mat4(1));
  both.append(half, scale({-1, 1, 1}));
  stage.add("curtain", "curtain velvet", both);
  std::vector<Vec3> path;
  for (int k = 0; k <= 14; ++k) {
    const float t = static_cast<float>(k) / 14;
    path.emplace_back(glm::mix(kOuter, -3.64f, t), kTie + 0.30f * (1 - t) - 0.12f * std::sin(kPi * t),
                      kZ + 0.26f + 0.03f * std::sin(kPi * t));
  }
  add_tube(cord, path, 0.035f, 10);
  MeshBuilder tassel;
  add_lathe(tassel,
            {{0, -0.36f},
             {0.062f, -0.35f},
             {0.045f, -0.12f},
             {0.03f, -0.09f},
             {0.05f, -0.05f},
             {0.04f, 0},
             {0, 0.02f}},
            14, 45);
  cord.append(tassel, move({-3.70f, kTie - 0.05f, kZ + 0.3f}));
  cords.append(cord, Mat4(1));
  cords.append(cord, scale({-1, 1, 1}));
  stage.add("curtain cords", "gold fringe", cords);
}

/// Swags along the top of the arch, with a fringe.
void add_valance(Stage& stage) {
  constexpr float kTop = kArchHeight + 0.15f, kHalf = kArchHalf + 0.2f, kZ = -0.55f;
  constexpr int kSwags = 7;
  const auto bow = [](float u) { return std::abs(std::sin(kPi * kSwags * u)); };
  const auto at = [&](float u, float v) {
    const float drop = 0.62f + 0.34f * bow(u), t = 1 - v;
    // Folds hang in bows of their own, deeper the lower.
    const float folds = 0.030f * std::sin(2 * kPi * (4.5f * t * (0.55f + 0.45f * bow(u))));
    return Vec3(glm::mix(-kHalf, kHalf, u), kTop - drop * t,
                kZ + 0.09f * bow(u) * std::sin(kPi * 0.8f * t) + folds * (0.3f + bow(u)));
  };
  MeshBuilder sheet, fringe;
  add_sheet(sheet, 140, 26, at, {2 * kHalf, 0.9f}, 75);
  stage.add("valance", "curtain velvet", sheet);
  std::vector<Vec3> edge;
  for (int k = 0; k <= 112; ++k) edge.push_back(at(static_cast<float>(k) / 112, 0));
  add_tube(fringe, edge, 0.036f, 8);
  stage.add("valance fringe", "gold fringe", fringe);
}

void add_masking(Stage& stage) {
  MeshBuilder cloth;
  for (const float z : {-2.3f, -4.3f, -6.3f}) {
    const auto fold = [z](float a, int n) {
      return z + 0.07f * std::sin(2 * kPi * static_cast<float>(n) * a);
    };
    for (const float side : {-1.0f, 1.0f}) {
      MeshBuilder leg;
      add_sheet(
          leg, 32, 2,
          [&](float u, float v) {
            return Vec3(glm::mix(4.7f, 6.7f, u), glm::mix(kFloor + 0.02f, 7.7f, v), fold(u, 7));
          },
          {2, 6.8f}, 75);
      cloth.append(leg, scale({side, 1, 1}));
    }
    MeshBuilder border;
    add_sheet(
        border, 96, 2,
        [&](float u, float v) {
          return Vec3(glm::mix(-6.7f, 6.7f, u), glm::mix(5.75f, 7.7f, v), fold(u, 24) + 0.25f);
        },
        {13.4f, 2}, 75);
    cloth.append(border, Mat4(1));
  }
  stage.add("legs and borders", "masking", cloth);
}

}  // namespace

void add_drapes(Stage& stage) {
  add_curtain(stage);
  add_valance(stage);
  add_masking(stage);
}

}  // namespace sconce::demo
