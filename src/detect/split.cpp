// SPDX-License-Identifier: Apache-2.0
#include "detect/split.h"

#include <map>

#include "core/error.h"

namespace sconce {

namespace {

class Splitter {
 public:
  Splitter(Mesh& mesh, const Mat3& linear, float longest) : mesh_(mesh), linear_(linear), longest_(longest) {}

  void run() {
    std::vector<Triangle> open = std::move(mesh_.triangles);
    mesh_.triangles.clear();
    while (!open.empty()) {
      const Triangle t = open.back();
      open.pop_back();
      const std::size_t e = longest_edge(t);
      const auto [a, b, c] = std::array{t.v[e], t.v[(e + 1) % 3], t.v[(e + 2) % 3]};
      if (!(length(a, b) > longest_)) {
        mesh_.triangles.push_back(t);
        continue;
      }
      const uint32_t m = middle(a, b);
      open.push_back({{a, m, c}});
      open.push_back({{m, b, c}});
    }
  }

 private:
  float length(uint32_t a, uint32_t b) const {
    return glm::length(linear_ * (mesh_.positions[b] - mesh_.positions[a]));
  }
  std::size_t longest_edge(const Triangle& t) const {
    std::size_t best = 0;
    for (std::size_t e = 1; e < 3; ++e)
      if (length(t.v[e], t.v[(e + 1) % 3]) > length(t.v[best], t.v[(best + 1) % 3])) best = e;
    return best;
  }
  uint32_t middle(uint32_t a, uint32_t b) {
    const auto [it, added] =
        middles_.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh_.positions.size()));
    if (!added) return it->second;
    const auto mean = [&](auto& all, auto&& fix) {
      if (!all.empty()) all.push_back(fix(0.5f * (all[a] + all[b])));
    };
    const auto same = [](const auto& v) { return v; };
    mean(mesh_.positions, same);
    mean(mesh_.normals, [&](const Vec3& n) { return normalize_or(n, mesh_.normals[a]); });
    mean(mesh_.tangents, [&](const glm::vec4& t) {
      return glm::vec4(normalize_or(Vec3(t), Vec3(mesh_.tangents[a])), mesh_.tangents[a].w);
    });
    for (std::vector<Vec2>& set : mesh_.texcoords) mean(set, same);
    return it->second;
  }

  Mesh& mesh_;
  Mat3 linear_;
  float longest_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

}  // namespace

Scene split_large_faces(Scene scene, float longest) {
  if (!(longest > 0))
    throw UsageError("splitting faces", "a longest edge of " + std::to_string(longest), "more than 0");
  std::vector<Mesh> meshes;
  // Instances may have different scales, so each has a mesh of its own.
  for (Instance& instance : scene.instances) {
    meshes.push_back(scene[instance.mesh]);
    Splitter(meshes.back(), Mat3(instance.transform), longest).run();
    instance.mesh = Id<Mesh>(meshes.size() - 1);
  }
  scene.meshes = std::move(meshes);
  return scene;
}

}  // namespace sconce
