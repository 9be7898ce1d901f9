// SPDX-License-Identifier: Apache-2.0
// scene.glb: the package's own geometry as plain glTF 2.0 that other tools open. The reader reads what the
// writer writes; foreign files are the importer's.
#pragma once

#include <string>
#include <string_view>

#include "scene/scene.h"

namespace sconce {

/// Node i is instance i; light and camera nodes follow. Float attributes, 32-bit indices, textures embedded.
/// Skies are named in the scene's extras; their radiance is not in the file.
/// @throws Error: a mesh without triangles or material, more than 4 GiB
std::string write_glb(const Scene& scene, const std::string& generator);

/// Groups come back as group names. Every offset and index is checked.
/// @throws Error naming `where`
Scene read_glb(std::string_view bytes, const std::string& where);

}  // namespace sconce
