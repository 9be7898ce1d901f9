// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

struct aiMaterial;
struct aiScene;

namespace sconce {

/// The file that a scene of another system names: as it stands, or else beside the scene, in whatever case.
std::filesystem::path find_beside(const std::filesystem::path& scene, std::string name);

/// Materials as assimp reads them: diffuse and emissive colour and map, opacity and its map (MTL: Kd, map_Kd,
/// Ke, map_Ke, d, map_d). Textures are decoded once; missing ones are warnings.
class AssimpMaterials {
 public:
  /// @param file  the scene's @param read  holds embedded textures
  AssimpMaterials(const std::filesystem::path& file, const aiScene& read, Scene& scene,
                  const Progress& progress)
      : file_(file), read_(read), scene_(scene), progress_(progress) {}

  void add(const aiMaterial& material);
  /// Maps that are seen in combined textures only. After the last add().
  void drop_unused_textures();

 private:
  Id<Texture> texture(const std::string& name);
  /// The colour map, or white, with the opacity map in its alpha. @param halves  gets whether more than a
  /// tenth is neither there nor not
  Id<Texture> cut_out(Id<Texture> color, const Texture& opacity, bool& halves);

  const std::filesystem::path& file_;
  const aiScene& read_;
  Scene& scene_;
  const Progress& progress_;
  std::map<std::string, Id<Texture>> known_;
};

/// Files of the textures that the materials name and that are there.
std::vector<std::filesystem::path> texture_files(const std::filesystem::path& file, const aiScene& read);

/// Textures that a file of import_assimp()'s formats names and that are there. @throws NotMyFormat, Error
std::vector<std::filesystem::path> assimp_files(const std::filesystem::path& file);

}  // namespace sconce
