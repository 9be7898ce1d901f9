// SPDX-License-Identifier: Apache-2.0
// Deferred shading: what is seen first, its light afterwards.
#pragma once

#include <string>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "scene/lens.h"

namespace sconce::gpu {

/// What one pass of a picture shows, per pixel: 28 bytes with the depth, 32 where there are normal maps.
struct SeenSurfaces {
  const Texture& depth;      ///< 0 where nothing is; there the others say nothing
  const Texture& surfaces;   ///< RGBA32UI: place, normals and colour as gpu/surface.glsl packs them
  const Texture& materials;  ///< RG32UI: what they mirror
  const Texture* mapped;     ///< R32UI: normals by normal maps; null where they are not seen
  bool directional;          ///< diffuse light sees them, too, as the lightmap's does
  const Lens& lens;          ///< that it was seen through
  Vec2 shift{0};             ///< of the picture below its sampling points, in pixels

  /// Runs a compute shader that begins with glsl() once per pixel.
  /// @param program  in use
  /// @param picture  RGBA floats of that size: radiance, cd/m2
  void shade(const Program& program, const Texture& picture) const;

  static constexpr int kUnits = 4;  ///< that shade() uses, from 0 on
  /// gpu/octahedral.glsl and gpu/seen_surfaces.glsl.
  static std::string glsl();
};

/// Light beside the lightmap's.
class AddedLight {
 public:
  virtual ~AddedLight() = default;
  /// Adds radiance, cd/m2, to what a pass of the picture shows.
  virtual void add(const SeenSurfaces& seen, const Texture& picture) = 0;
};

/// gpu/octahedral.glsl
std::string_view octahedral_glsl();

}  // namespace sconce::gpu
