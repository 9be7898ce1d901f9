// SPDX-License-Identifier: Apache-2.0
// A mix written back into the scene: lamps and emitters as strong and coloured as their faders make them.
#pragma once

#include "mix/settings.h"

namespace sconce {

/// The package's scene with all lights multiplied by their groups' weights; lamps that are off are gone.
Scene relit_scene(const Package& package, const MixSpec& mix);

struct SceneFiles {
  std::vector<std::filesystem::path> files;  ///< .glb, .toml, and .sky.exr where there is a sky
  std::vector<std::string> warnings;         ///< what glTF cannot say
};
/// Writes NAME.glb and its side file NAME.toml, which holds the sky. Each is written beside, then renamed.
/// @throws Error where NAME.toml is somebody's own
SceneFiles write_scene(const std::filesystem::path& glb, const Package& package, const MixSpec& mix);

}  // namespace sconce
