// SPDX-License-Identifier: Apache-2.0
// A rubber plant in the corner, a sword plant on the window sill, a vine on the shelf.
#include "bathroom.h"
#include "core/hash.h"

namespace sconce::demo {
namespace {

float random(uint32_t plant, uint32_t leaf, uint32_t k) {
  return static_cast<float>(mix32(plant, mix32(leaf, k)) >> 8) / static_cast<float>(1 << 24);
}

struct Leaf {
  Vec3 base, direction;
  float length, width;
  float droop;   ///< how far the tip hangs, in lengths
  float folded;  ///< how much the halves rise from the midrib, in widths
  float point;   ///< where it is widest: 0.5 oval, less nearer the stalk
};

void add_leaf(MeshBuilder& out, const Leaf& leaf, int pieces) {
  const Vec3 along = glm::normalize(leaf.direction);
  const Vec3 side = normalize_or(glm::cross(along, Vec3(0, 1, 0)), Vec3(1, 0, 0)),
             up = glm::cross(side, along);
  const float power = std::log(0.5f) / std::log(leaf.point);
  add_sheet(
      out, 4, pieces,
      [&](float u, float v) {
        const float across = 2 * u - 1;
        const float wide =
            0.5f * leaf.width *
                std::pow(std::max(std::sin(kPi * std::pow(std::max(v, 1e-4f), power)), 0.0f), 0.75f) +
            0.001f;
        const Vec3 rib = leaf.base + along * (leaf.length * v) - Vec3(0, leaf.droop * leaf.length * v * v, 0);
        return rib + side * (across * wide) + up * (leaf.folded * std::abs(across) * wide);
      },
      {1, 1}, 80);
}

void add_rubber_plant(Stage& stage) {
  const Vec3 foot(0.27f, 0, 0.19f);
  MeshBuilder pot, soil, stems, leaves;
  MeshBuilder shape;
  add_lathe(shape,
            {{0.105f, 0},
             {0.110f, 0.006f},
             {0.128f, 0.26f},
             {0.131f, 0.285f},
             {0.128f, 0.29f},
             {0.122f, 0.288f},
             {0.119f, 0.25f}},
            32, 40);
  pot.append(shape, move(foot));
  stage.add("plant pot", "basket", pot);
  MeshBuilder disk;
  add_disk(disk, 0.1195f, 32);
  soil.append(disk, move(foot + Vec3(0, 0.252f, 0)));
  stage.add("plant soil", "soil", soil);

  uint32_t id = 0;
  const Vec3 tips[3] = {{0.05f, 1.22f, 0.10f}, {-0.10f, 1.02f, 0.16f}, {0.20f, 0.98f, 0.02f}};
  for (const Vec3& tip : tips) {
    const Vec3 base = foot + Vec3(0.2f * tip.x, 0.24f, 0.2f * tip.z);
    const auto stem =
        smooth_curve<Vec3>({base, foot + Vec3(0.4f * tip.x, 0.55f * tip.y, 0.4f * tip.z), foot + tip}, 6);
    add_tube(stems, stem, 0.007f, 8, false);
    for (std::size_t k = 4; k < stem.size(); ++k, ++id) {
      const float angle = 2.4f * static_cast<float>(id) + 0.5f * random(1, id, 0);
      const float last = static_cast<float>(k) / static_cast<float>(stem.size() - 1),
                  rise = 0.25f + 0.9f * last * last;
      // Away from the two walls.
      Vec3 out(std::cos(angle), rise, std::sin(angle));
      out.x += 0.25f, out.z += 0.35f;
      const float length = 0.17f + 0.09f * random(1, id, 1);
      const Vec3 stalk = stem[k] + 0.03f * glm::normalize(out);
      add_tube(stems, {stem[k], stalk}, 0.003f, 6, false, false);
      add_leaf(leaves, {stalk, out, length, 0.45f * length, 0.25f + 0.3f * random(1, id, 2), 0.25f, 0.45f},
               6);
    }
  }
  stage.add("plant stems", "stem", stems);
  stage.add("plant leaves", "leaf", leaves);
}

void add_sword_plant(Stage& stage) {
  const Vec3 foot(-0.006f, kWindowLo.y + 0.025f, 0.70f);
  MeshBuilder shape, pot, blades;
  add_lathe(shape,
            {{0.045f, 0},
             {0.048f, 0.004f},
             {0.060f, 0.095f},
             {0.060f, 0.105f},
             {0.055f, 0.105f},
             {0.053f, 0.09f},
             {0, 0.088f}},
            24, 40);
  pot.append(shape, move(foot));
  stage.add("sill pot", "clay", pot);
  for (uint32_t k = 0; k < 9; ++k) {
    const float angle = 2.4f * static_cast<float>(k), lean = 0.06f + 0.22f * random(2, k, 0);
    const Vec3 out(lean * std::cos(angle) * 0.7f, 1, lean * std::sin(angle));
    const Vec3 base = foot + Vec3(0.022f * std::cos(angle), 0.085f, 0.022f * std::sin(angle));
    add_leaf(blades, {base, out, 0.20f + 0.15f * random(2, k, 1), 0.034f, 0.0f, 0.35f, 0.35f}, 6);
  }
  stage.add("sill plant", "leaf", blades);
}

void add_vine(Stage& stage) {
  const Vec3 foot(0.645f, 1.78f, 0.10f);
  MeshBuilder shape, pot, vines, leaves;
  add_lathe(shape,
            {{0.050f, 0},
             {0.054f, 0.005f},
             {0.062f, 0.085f},
             {0.060f, 0.095f},
             {0.055f, 0.094f},
             {0.053f, 0.08f},
             {0, 0.078f}},
            24, 40);
  pot.append(shape, move(foot));
  stage.add("vine pot", "ceramic", pot);
  uint32_t id = 0;
  const float falls[6] = {0.62f, 0.42f, 0.50f, 0.26f, 0.10f, 0.14f};
  for (uint32_t v = 0; v < 6; ++v) {
    const float angle = -0.35f + 0.52f * static_cast<float>(v), reach = 0.085f + 0.03f * random(3, v, 1);
    const Vec3 out(std::cos(angle), 0, std::sin(angle));
    const Vec3 rim = foot + 0.05f * out + Vec3(0, 0.10f, 0), over = foot + reach * out;
    std::vector<Vec3> points{foot + Vec3(0, 0.075f, 0), rim, over + Vec3(0, 0.075f, 0)};
    for (float y = 0; y < falls[v]; y += 0.12f)
      points.push_back(over + Vec3(0.012f + 0.02f * (random(3, v, 5 + static_cast<uint32_t>(y * 100)) - 0.3f),
                                   0.0f - y, 0.02f * random(3, v, 50 + static_cast<uint32_t>(y * 100))));
    const auto path = smooth_curve<Vec3>(points, 4);
    add_tube(vines, path, 0.0022f, 5, false);
    for (std::size_t k = 3; k < path.size(); k += 2, ++id) {
      const float turn_by = angle + (id % 2 ? 1.0f : -1.0f) * (0.7f + 0.5f * random(3, id, 9));
      const Vec3 facing(std::cos(turn_by), 0.35f - 0.3f * random(3, id, 10),
                        std::max(std::sin(turn_by), -0.2f) + 0.25f);
      const float length = 0.05f + 0.025f * random(3, id, 11);
      add_leaf(leaves, {path[k], facing, length, 0.72f * length, 0.55f, 0.18f, 0.38f}, 5);
    }
  }
  stage.add("vine stems", "stem", vines);
  stage.add("vine leaves", "young leaf", leaves);
}

}  // namespace

void add_plants(Stage& stage) {
  add_rubber_plant(stage);
  add_sword_plant(stage);
  add_vine(stage);
}

}  // namespace sconce::demo
