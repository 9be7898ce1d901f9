// SPDX-License-Identifier: Apache-2.0
// A package's triangles as vertex shaders want them, without any OpenGL: what the device's buffers and the
// web page's hold.
#pragma once

#include <vector>

#include "package/shown_scene.h"

namespace sconce::gpu {

/// What gpu/surface_vertex.glsl reads; texture transforms are applied already.
struct SurfaceVertex {
  Vec3 position;
  Vec2 base, metallic, emission;
  Vec3 front, back;  ///< lightmap: u, v, page
};
static_assert(sizeof(SurfaceVertex) == 15 * sizeof(float));

/// Triangles that share all that is set between draws.
struct SurfaceBatch {
  Id<Material> material;
  Id<LightGroup> group;             ///< of what emits
  std::vector<uint32_t> triangles;  ///< of the World, in its order
};
std::vector<SurfaceBatch> surface_batches(const ShownScene& shown);

SurfaceVertex surface_vertex(const ShownScene& shown, std::size_t triangle, std::size_t corner);
/// Where a corner of a triangle is in a texture.
Vec2 place_in(const TextureUse& use, const World& world, std::size_t triangle, std::size_t corner);

}  // namespace sconce::gpu
