// SPDX-License-Identifier: Apache-2.0
// A mix written back into the scene: lamps and emitters as strong and coloured as their faders make them.
#pragma once

#include <filesystem>

#include "mix/settings.h"
#include "scene/scene.h"

namespace sconce {

/// All lights multiplied by their groups' weights; lamps that are off are gone.
/// @param scene  with groups; lamps and objects where they are
Scene relit_scene(Scene scene, const MixSpec& mix);

struct SceneFiles {
  std::vector<std::filesystem::path> files;  ///< .glb, .toml, and .sky.exr where there is a sky
  std::vector<std::string> warnings;         ///< what glTF cannot say
};
/// Writes NAME.glb and its side file NAME.toml, which holds the sky. Each is written beside, then renamed.
/// @param scene      relit_scene(), and what else shines
/// @param generator  that glTF names
/// @throws Error where NAME.toml is somebody's own
SceneFiles write_scene(const std::filesystem::path& glb, Scene scene, const std::string& generator);

/// The warning of a lamp that the scene which is written lacks.
std::string shader_left_out(const std::string& lamp);

}  // namespace sconce
