// SPDX-License-Identifier: Apache-2.0
// Cutting a surface into pieces that can be laid flat.
#pragma once

#include <cstdint>
#include <vector>

#include "receive/mesh_graph.h"

namespace sconce {

/// A piece of surface: World triangles, connected, ascending.
using Patch = std::vector<uint32_t>;

/// Grows patches over smooth edges by normal cone and boundary length, largest triangles first; then joins
/// patches smaller than a couple of texels with their neighbours. Every triangle is in exactly one patch.
/// @param texels  per triangle: edge length of a texel there, metres
/// @param kinds   per triangle: patches never span two kinds
std::vector<Patch> cut_into_patches(const World& world, const MeshGraph& graph,
                                    const std::vector<float>& texels, const std::vector<uint8_t>& kinds);

/// Cuts a patch in two connected halves around the two triangles that are farthest apart, in direction where
/// it is curved, in space where it is not. @pre at least two triangles
std::pair<Patch, Patch> halve(const World& world, const MeshGraph& graph, const Patch& patch);

}  // namespace sconce
