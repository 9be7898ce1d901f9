// SPDX-License-Identifier: Apache-2.0
// What making an operator costs against the size of a scene, whose triangles are cut into four again and
// again: the light stays the same. As Markdown, with fitted exponents; CPU time of all threads, which a busy
// machine does not lengthen much; every row in a process of its own. Usage: transfer_growth SCENE [CUTS WIDTH
// HEIGHT GATHER]. The table: bench/results/transfer_growth.md.
#include <chrono>

#include "growth.h"
#include "import/import.h"
#include "relight/precompute.h"
#include "scene/groups.h"
#include "words.h"

using namespace sconce;

namespace {

/// Triangles cut at the middles of their sides.
void cut(Mesh& mesh) {
  std::vector<Triangle> triangles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    mesh.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
    if (!mesh.normals.empty())
      mesh.normals.push_back(normalize_or(mesh.normals[a] + mesh.normals[b], mesh.normals[a]));
    for (std::vector<Vec2>& set : mesh.texcoords)
      if (!set.empty()) set.push_back(0.5f * (set[a] + set[b]));
    return static_cast<uint32_t>(mesh.positions.size() - 1);
  };
  mesh.tangents.clear();
  for (const auto& [v] : mesh.triangles) {
    const uint32_t ab = middle(v[0], v[1]), bc = middle(v[1], v[2]), ca = middle(v[2], v[0]);
    for (const Triangle& part : {Triangle{{v[0], ab, ca}}, Triangle{{ab, v[1], bc}}, Triangle{{ca, bc, v[2]}},
                                 Triangle{{ab, bc, ca}}})
      triangles.push_back(part);
  }
  mesh.triangles = std::move(triangles);
}

struct Cost {
  std::size_t triangles;
  double cpu, wall;  ///< seconds
};

Cost run(const Scene& scene, const TransferParams& params, int width, int height) {
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const TracedScene traced{scene, world, tracer};
  const double before = cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  make_operator(traced, pixel_receivers(traced, scene.cameras.at(0), width, height), params, "");
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {world.size(), cpu_seconds() - before, wall.count()};
}

void report(const Words& words) {
  TransferParams params;
  params.gather = static_cast<std::size_t>(words.number(5, 65536));
  const int cuts = words.number(2, 3), width = words.number(3, 640), height = words.number(4, 480);
  check(params);
  fmt::print("{}, {} x {}, {} slots\n\n| triangles | CPU s | wall s | peak MB |\n|---:|---:|---:|---:|\n",
             words.name(1), width, height, params.gather);
  std::vector<double> triangles, cpu, wall, memory;
  for (int i = 0; i <= cuts; ++i) {
    const auto [cost, megabytes] = in_own_process<Cost>([&] {
      Scene scene = import_scene(words.name(1));
      assign_groups(scene, Grouping::automatic);
      for (int k = 0; k < i; ++k)
        for (Mesh& mesh : scene.meshes) cut(mesh);
      return run(scene, params, width, height);
    });
    triangles.push_back(static_cast<double>(cost.triangles));
    cpu.push_back(cost.cpu), wall.push_back(cost.wall), memory.push_back(megabytes);
    fmt::print("| {} | {:.1f} | {:.1f} | {:.0f} |\n", cost.triangles, cost.cpu, cost.wall, megabytes);
    std::fflush(stdout);
  }
  fmt::print("| exponent | {:.2f} | {:.2f} | {:.2f} |\n", exponent(triangles, cpu), exponent(triangles, wall),
             exponent(triangles, memory));
}

}  // namespace

int main(int argc, char** argv) {
  return run_with_words(argc, argv, 1, "transfer_growth SCENE [CUTS [WIDTH [HEIGHT [GATHER]]]]", report);
}
