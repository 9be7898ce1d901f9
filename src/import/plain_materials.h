// SPDX-License-Identifier: Apache-2.0
// Materials of formats that know colours and pictures of them, but no physics.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

namespace sconce {

/// The grey of what has no material, or one without a colour.
inline const Rgb kUnsaidDiffuse{0.6f};

struct PlainMaterial {
  struct Map {
    std::string file;  ///< as it is named; "" = none
    bool clamped = false;
  };
  std::string name;
  Rgb diffuse{0.8f}, emissive{0};
  float opacity = 1;
  Map diffuse_map, emissive_map, opacity_map;
};

/// The file that a scene of another system names: as it stands, or else beside the scene, in whatever case.
std::filesystem::path find_beside(const std::filesystem::path& scene, std::string name);

/// Adds them to a scene. Textures are decoded once; missing ones are warnings, and grey.
class PlainMaterials {
 public:
  /// The bytes of a picture by its name. @throws Error
  using Pictures = std::function<std::vector<unsigned char>(const std::string& name)>;

  /// @param file  the scene's
  PlainMaterials(const std::filesystem::path& file, Pictures pictures, Scene& scene, const Progress& progress)
      : file_(file), pictures_(std::move(pictures)), scene_(scene), progress_(progress) {}

  void add(const PlainMaterial& material);
  /// Maps that are seen in combined textures only. After the last add().
  void drop_unused_textures();

 private:
  Id<Texture> texture(const std::string& name);
  /// @return false where the map is there but its picture is not
  bool use(const PlainMaterial::Map& map, TextureUse& use);
  /// The colour map, or white, with the opacity map in its alpha. @param halves  gets whether more than a
  /// tenth is neither there nor not
  Id<Texture> cut_out(Id<Texture> color, const Texture& opacity, bool& halves);

  const std::filesystem::path& file_;
  Pictures pictures_;
  Scene& scene_;
  const Progress& progress_;
  std::map<std::string, Id<Texture>> known_;
};

/// Bytes of the picture that lies beside the scene. @throws Error
std::vector<unsigned char> picture_beside(const std::filesystem::path& scene, const std::string& name);

}  // namespace sconce
