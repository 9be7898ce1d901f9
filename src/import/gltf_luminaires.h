// SPDX-License-Identifier: Apache-2.0
// Measured lamps of a glTF file: EXT_lights_ies, extras.luminaire, nodes named "ies:FILE".
#pragma once

#include <map>

#include "import/gltf_parts.h"
#include "import/luminaires.h"

namespace sconce {

class GltfLuminaires {
 public:
  GltfLuminaires(const GltfSource& source, Scene& scene, const Progress& progress)
      : source_(source), scene_(scene), files_(scene, progress) {}

  /// The measured lamp at a node, where it names one. With EXT_lights_ies, and where it replaces a lamp of
  /// KHR_lights_punctual, it shines along -z of the node, else along -y.
  /// @throws Error naming the node
  std::optional<Light> read(const tinygltf::Node& node, const GltfNode& here, const std::string& place);

 private:
  Id<Luminaire> profile(int index, const std::string& place);

  const GltfSource& source_;
  Scene& scene_;
  LuminaireFiles files_;
  std::map<int, Id<Luminaire>> profiles_;
};

}  // namespace sconce
