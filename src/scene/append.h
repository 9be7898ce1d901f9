// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace sconce {

/// Puts the textures, materials, meshes and instances of a part behind those of a scene. Lights and cameras
/// stay out.
void append(Scene& scene, Scene part);

}  // namespace sconce
