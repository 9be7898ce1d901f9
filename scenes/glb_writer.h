// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/scene.h"

namespace sconce::demo {

/// The scene as one binary glTF 2.0 file: meshes, materials, PNG textures, cameras; emission through
/// KHR_materials_emissive_strength, groups and lightmap scales as node extras. Same scene, same bytes.
std::string write_glb(const Scene& scene);

}  // namespace sconce::demo
