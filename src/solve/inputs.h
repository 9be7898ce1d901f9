// SPDX-License-Identifier: Apache-2.0
// What layers depend on, as hashes: equal means that a layer need not be solved again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/world.h"

namespace sconce {

/// One hash per scene group, of geometry, materials without emission, cameras and texel densities (which the
/// atlas follows), `how`, and the group's own lamps; not of other groups' lamps, nor of names.
/// @param how  text that names the solver, its options, the atlas's, the program's version
/// @pre assign_groups() was called
std::vector<std::string> layer_inputs(const Scene& scene, const World& world, std::string_view how);

}  // namespace sconce
