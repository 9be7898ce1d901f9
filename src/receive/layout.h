// SPDX-License-Identifier: Apache-2.0
// An atlas as bytes, so that a later bake can put its layers onto the same texels. Format:
// docs/package-format.md.
#pragma once

#include <string>
#include <string_view>

#include "receive/atlas.h"

namespace sconce {

/// All of the atlas but its warnings and what TexelReceivers counts.
std::string pack_layout(const Atlas& atlas);
/// @param triangles  of the World it belongs to
/// @throws Error naming `where`: damaged, or of another world
Atlas unpack_layout(std::string_view bytes, std::size_t triangles, const std::string& where);

}  // namespace sconce
