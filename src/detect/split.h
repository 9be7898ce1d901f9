// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace sconce {

/// Splits edges longer than `longest` in their middle until there are none: for renderers that take the
/// ambient term per vertex, since light between vertices is interpolated. Whether an edge is split depends on
/// it alone, so that faces that met still meet. Everything that vertices have is interpolated.
/// @param longest  m, in the world
Scene split_large_faces(Scene scene, float longest);

}  // namespace sconce
