// SPDX-License-Identifier: Apache-2.0
// Bottles and jars, standing on y = 0.
#pragma once

#include "stage.h"

namespace sconce::demo {

/// Round bottle with shoulders and a neck; `height` is that of the body with its neck.
MeshBuilder pump_bottle(float radius, float height);
/// The pump of a bottle of this height; its spout points along +x.
MeshBuilder pump(float height);
/// Straight jar with a rounded edge and a lid.
MeshBuilder jar(float radius, float height);
/// Open cup.
MeshBuilder cup(float radius, float height);
/// Bottle vase with a narrow neck.
MeshBuilder vase(float radius, float height);

void add_vessel(Stage& stage, const char* name, const char* material, const MeshBuilder& shape, Vec3 at,
                float turn_degrees = 0);

}  // namespace sconce::demo
