// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/progress.h"
#include "scene/scene.h"

namespace sconce {

/// Checks a scene once, after import, and mends what can be mended with a warning: non-finite vertices and
/// their triangles, negative colours, cones, missing texture coordinates, surprising albedos and sizes, no
/// lamps.
/// @throws Error: an id out of range, attributes of different lengths
void validate(Scene& scene, const Progress& progress = {});

}  // namespace sconce
