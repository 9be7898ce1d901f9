// SPDX-License-Identifier: Apache-2.0
// Deferred shading: what is seen first, its light afterwards.
#pragma once

#include <string>

#include "gpu/program.h"
#include "gpu/texture.h"

namespace sconce::gpu {

/// What one pass of a picture shows, per pixel: RGBA float textures.
struct SeenSurfaces {
  const Texture& depth;    ///< 0 where nothing is; there the others say nothing
  const Texture& place;    ///< xyz, m
  const Texture& normals;  ///< towards the camera, octahedral: xy interpolated, zw the face's
  const Texture& albedo;   ///< diffuse; black on backs that are

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
