// SPDX-License-Identifier: Apache-2.0
// Small procedural textures, sRGB, all of which repeat without a seam.
#pragma once

#include "image/image.h"

namespace sconce::demo {

Image8 terrazzo();    ///< 2 x 2 floor tiles of 0.6 m with stone chips and joints
Image8 wall_tiles();  ///< 8 x 4 glazed wall tiles of 0.075 x 0.2 m, each a little different, and their joints
Image8 floor_mosaic();                                         ///< 4 x 4 shower floor tiles of 0.15 m
Image8 oak();                                                  ///< straight grain along v
Image8 rug();                                                  ///< the whole rug: stripes across u
Image8 terry(const char* srgb_body, const char* srgb_stripe);  ///< towel: v runs along its length
Image8 mirror_sheen();  ///< a soft diagonal sheen that lets a diffuse surface read as glass

}  // namespace sconce::demo
