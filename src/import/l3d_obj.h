// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "import/l3d_structure.h"

namespace sconce {

/// Name of the material that faces of surface i get.
std::string l3d_material(std::size_t surface);

/// An OBJ text whose faces that shine have a material of their own per surface, for a reader of OBJ files.
/// Faces count within their group (`g` or `o` lines; those before the first are group 0).
/// @throws Error naming `where`: a face that is not there
std::string marked_obj(std::string_view text, const std::vector<L3dSurface>& surfaces,
                       const std::string& where);

}  // namespace sconce
