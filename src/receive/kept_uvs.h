// SPDX-License-Identifier: Apache-2.0
// Texture coordinate sets that serve as lightmap coordinates as they stand.
#pragma once

#include "receive/pack.h"

namespace sconce {

struct KeptUvs {
  std::vector<uint8_t> triangles;  ///< per World triangle: 1 where its set is kept; empty = nowhere
  std::vector<Chart> charts;       ///< the islands, uv in metres within their block
  std::vector<Block> blocks;
  bool joint = false;  ///< one set of all meshes fills one page as it stands: blocks[0], a square
};

/// A set that never overlaps over all instances is kept whole (sets from 1 up are preferred to set 0, which
/// is mostly for textures). Otherwise every instance whose own set from 1 up never overlaps keeps that layout
/// as one rigid block.
/// @param texels  per triangle: expected edge length of a texel, metres; islands closer than two texels are
/// not kept
KeptUvs find_kept_uvs(const World& world, const MeshGraph& graph, const std::vector<float>& texels);

/// Page 0 is the joint layout; the other blocks (twins) are packed on further pages of the same size.
Packing pack_beside_joint(const std::vector<Block>& blocks, const std::vector<Chart>& charts,
                          const AtlasParams& params, std::vector<std::string>& warnings);

}  // namespace sconce
