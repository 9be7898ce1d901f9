// SPDX-License-Identifier: Apache-2.0
// What making an operator costs against the size of a scene, whose triangles are cut into four again and
// again: the light stays the same. As Markdown; CPU time of all threads, which a busy machine does not
// lengthen much. Usage: transfer_growth SCENE [CUTS WIDTH HEIGHT GATHER]. The table:
// bench/results/transfer.md.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <ctime>

#include "import/import.h"
#include "relight/precompute.h"
#include "scene/groups.h"

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

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  Scene scene = import_scene(argv[1]);
  assign_groups(scene, Grouping::automatic);
  TransferParams params;
  params.gather = static_cast<std::size_t>(number(5, 65536));
  const int width = number(3, 640), height = number(4, 480);
  fmt::print(
      "{}, {} x {}, {} slots\n\n| triangles | CPU s | wall s | MB while computing, the most so far |\n",
      argv[1], width, height, params.gather);
  fmt::print("|---|---|---|---|\n");
  for (int i = 0; i <= number(2, 3); ++i) {
    if (i > 0)
      for (Mesh& mesh : scene.meshes) cut(mesh);
    const World world = make_world(scene);
    const Tracer tracer(scene, world);
    const TracedScene traced{scene, world, tracer};
    const double before = cpu_seconds();
    const auto start = std::chrono::steady_clock::now();
    make_operator(traced, pixel_receivers(traced, scene.cameras.at(0), width, height), params, "");
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} |\n", world.size(), cpu_seconds() - before, wall.count(),
               static_cast<double>(usage.ru_maxrss) / 1024);
    std::fflush(stdout);
  }
  return 0;
}
