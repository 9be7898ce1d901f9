// SPDX-License-Identifier: Apache-2.0
// Places for charts on pages.
#pragma once

#include <vector>

#include "receive/atlas.h"
#include "receive/parameterize.h"

namespace sconce {

/// Charts that keep their places relative to each other: one generated chart, or the layout of a mesh's own
/// set.
struct Block {
  std::vector<uint32_t> charts;
  Vec2 size{0};     ///< metres
  float scale = 1;  ///< linear density scale
};

struct Placement {
  int page = -1;
  Vec2 origin{0};  ///< texel coordinates of the block's corner
  float texels_per_metre = 1;
};

struct Packing {
  int width = 0, height = 0, pages = 0;
  float density = 0;  ///< texels per metre at scale 1
  std::vector<Placement> blocks;
};

/// Shapes are packed by what they cover, not by their boxes. Blocks are at least `gutter` texels apart, and
/// half of that from the page's border. With params.density: as many pages as needed, of the size that wastes
/// least; with page_size alone: the density that fills one page.
/// @throws Error when page_size is too small for the number of charts
Packing pack(const std::vector<Block>& blocks, const std::vector<Chart>& charts, const AtlasParams& params,
             std::vector<std::string>& warnings);

}  // namespace sconce
