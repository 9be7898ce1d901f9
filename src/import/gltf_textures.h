// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "import/gltf_source.h"
#include "scene/scene.h"

namespace sconce {

/// Base colour in place of a texture that is missing.
inline constexpr float kMissingTextureGrey = 0.5f;

/// Decodes the textures that are asked for, each picture once, and appends them to the scene.
class GltfTextures {
 public:
  GltfTextures(const GltfSource& source, Scene& scene, const Progress& progress)
      : source_(source), scene_(scene), progress_(progress) {}

  /// No id where the picture is missing or damaged; a warning has named it. @throws Error on indices out of
  /// range
  Id<Texture> load(int texture, const std::string& place);

 private:
  struct Picture {
    Image8 pixels;
    Bytes file;
    std::string mime;
  };
  const std::optional<Picture>& picture(int image, const std::string& place);

  const GltfSource& source_;
  Scene& scene_;
  const Progress& progress_;
  std::map<int, std::optional<Picture>> pictures_;
  std::map<std::tuple<int, int, int, int>, Id<Texture>> made_;  ///< image, wraps, filter
};

}  // namespace sconce
