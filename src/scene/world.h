// SPDX-License-Identifier: Apache-2.0
// All instances made real: one indexed triangle soup in world space, which rays, atlas and lights work on.
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"

namespace sconce {

struct World {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;        ///< per vertex, unit; zero = use the face normal
  std::vector<glm::vec4> tangents;  ///< per vertex, xyz unit or zero = none; empty where no mesh has any
  std::vector<std::vector<Vec2>>
      texcoords;                    ///< set -> vertex; as many sets as any mesh has, zero where it has none
  std::vector<Triangle> triangles;  ///< wound counter-clockwise from the front, mirrored instances too
  std::vector<Vec3> face_normals;   ///< per triangle, unit
  std::vector<Id<Instance>> instances;     ///< per triangle
  std::vector<Id<Material>> materials;     ///< per triangle
  std::vector<uint32_t> source_triangles;  ///< per triangle: its index in its mesh
  Bounds bounds;

  std::size_t size() const { return triangles.size(); }
  float area(std::size_t triangle) const;
  Vec3 position(std::size_t triangle, Vec2 barycentric) const;
  /// Interpolated NORMAL on the side of the face normal of the front; the face normal where absent.
  Vec3 normal(std::size_t triangle, Vec2 barycentric) const;
  /// Barycentric (u, v) weighs vertices 1 and 2.
  Vec2 texcoord(std::size_t triangle, Vec2 barycentric, uint32_t set) const;
};

/// Degenerate (zero-area, non-finite) triangles are left out. @throws Error when nothing is left
World make_world(const Scene& scene);

/// Linear texture look-up with the slot's transform and the texture's wrapping, bilinear; sRGB decoded when
/// asked.
struct Texel {
  Rgb rgb{1.0f};
  float alpha = 1;
};
Texel sample_texture(const Scene& scene, const TextureUse& use, Vec2 uv, bool srgb);

/// Per corner of a triangle, what its material's normal map is laid out along: xyz the direction in which the
/// map's u grows, w < 0 where its up is -cross(normal, xyz). The mesh's tangents; where it has none, from the
/// map's coordinates.
std::array<glm::vec4, 3> map_tangents(const Scene& scene, const World& world, std::size_t triangle);
/// The normal that a material's normal map gives minus World::normal(), on the front; 0 where there is no
/// map. On the back it is the opposite.
Vec3 normal_offset(const Scene& scene, const World& world, std::size_t triangle, Vec2 barycentric);

/// Material at a point. Base colour after texture; metals keep it as diffuse reflectance in bounces
/// (contract.md).
struct Shade {
  Rgb base_color, emission;
  float alpha = 1, metallic = 0, roughness = 1, transmission = 0;
  Rgb receiver_albedo() const { return base_color * (1.0f - metallic); }
};
Shade shade(const Scene& scene, const World& world, std::size_t triangle, Vec2 barycentric);

/// What goes straight through a surface, seen and unseen (docs/adr/0036-panes.md).
struct Passing {
  float clear = 0;        ///< share of the place where there is no surface: passes as it is
  float transmitted = 0;  ///< of the light on the surface: passes in its base colour
  Rgb base_color;

  float share() const { return clear + (1 - clear) * transmitted; }
  Rgb rgb() const { return Rgb(clear) + (1 - clear) * transmitted * base_color; }
};
/// @param surface  shade() of a material that passes (Scene::passes)
Passing passing(const Material& material, const Shade& surface);

}  // namespace sconce
