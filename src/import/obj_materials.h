// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/progress.h"
#include "scene/scene.h"

struct aiMaterial;

namespace sconce {

/// MTL materials as assimp read them: Kd, map_Kd, Ke, map_Ke, d. Textures are decoded once; missing ones are
/// warnings.
class ObjMaterials {
 public:
  ObjMaterials(const std::filesystem::path& obj, Scene& scene, const Progress& progress)
      : obj_(obj), scene_(scene), progress_(progress) {}

  void add(const aiMaterial& material);

 private:
  Id<Texture> texture(const std::string& name);

  const std::filesystem::path& obj_;
  Scene& scene_;
  const Progress& progress_;
  std::map<std::string, Id<Texture>> known_;
};

/// The MTL files that an OBJ names.
std::vector<std::filesystem::path> mtl_files(const std::filesystem::path& obj);

/// The MTL files and textures that an OBJ names and that are there.
std::vector<std::filesystem::path> obj_files(const std::filesystem::path& obj);

}  // namespace sconce
