// SPDX-License-Identifier: Apache-2.0
// A side file, applied to a scene of one triangle.
#include "fuzz.h"
#include "import/import.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("scene.toml");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] {
    Scene scene;
    scene.materials.emplace_back().name = "paint";
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.material = Id<Material>(0);
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{{0, 1, 2}}};
    Instance& instance = scene.instances.emplace_back();
    instance.name = "wall", instance.mesh = Id<Mesh>(0);
    apply_side_file(path, scene);
  });
}
