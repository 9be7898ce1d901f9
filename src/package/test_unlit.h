// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks only: a scene to be looked at without a bake.
#pragma once

#include "package/package.h"

namespace sconce {

/// A package NAME.sconce in a folder, without any light in it. @return it, open
inline Package unlit(Scene scene, const std::filesystem::path& folder) {
  PackageContents out;
  out.manifest.width = out.manifest.height = 1, out.manifest.pages = 1;
  out.manifest.density = 1;
  for (Mesh& mesh : scene.meshes) mesh.texcoords.resize(1, std::vector<Vec2>(mesh.positions.size()));
  out.manifest.instance_pages.assign(scene.instances.size(), -1);
  out.manifest.instance_twins.assign(scene.instances.size(), -1);
  out.scene = std::move(scene);
  out.receivers = {Image(1, 1, {"albedo.R", "albedo.G", "albedo.B", "weight"})};
  write_package(folder / "room.sconce", std::move(out));
  return Package::open(folder / "room.sconce");
}

}  // namespace sconce
