// SPDX-License-Identifier: Apache-2.0
// Emissive meshes as area lights, sampled by area x texel of the emission texture.
#pragma once

#include "light/lamp.h"

namespace sconce {

/// @param triangles  the instance's emissive triangles, consecutive in the world
Lamp make_mesh_lamp(const Scene& scene, const World& world, Id<Instance> instance, uint32_t first,
                    uint32_t count);

/// MeshLamp::sample with the emission of the very point.
bool sample(const MeshLamp& lamp, const Scene& scene, const World& world, const Vec3& x, Vec2 u,
            LightSample& out);
/// Cosine-distributed about the face, from both sides of a two-sided lamp alike.
EmittedLight emit(const MeshLamp& lamp, const Scene& scene, const World& world, Vec2 where, Vec2 whither);
float pdf(const MeshLamp& lamp, const World& world, uint32_t triangle, Vec2 barycentric, float distance,
          const Vec3& direction);
/// Emission at a point, black where the alpha mask cuts it away. cd/m2
Rgb emission_at(const Scene& scene, const World& world, uint32_t triangle, Vec2 barycentric);

}  // namespace sconce
