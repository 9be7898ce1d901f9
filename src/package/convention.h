// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace sconce {

/// What a lightmap's numbers mean, in words, for whoever finds an export without our documents.
/// @param uv_set  Manifest::lightmap_set
inline std::string lightmap_convention(uint32_t uv_set) {
  return "illuminance E in lux, linear Rec. 709, all bounces, without the surface's albedo; a diffuse "
         "surface "
         "shows the luminance albedo * E / pi in cd/m2; looked up by TEXCOORD_" +
         std::to_string(uv_set) +
         " of the package's scene.glb, bilinearly, clamped, without mipmaps; row 0 is v = 0";
}

}  // namespace sconce
