// SPDX-License-Identifier: Apache-2.0
// Simple shapes as instances of a scene, for tests, benchmarks and made-up rooms.
#pragma once

#include "scene/scene.h"

namespace sconce {

/// A diffuse material. @param emission  cd/m2
Id<Material> add_material(Scene& scene, const std::string& name, const Rgb& base_color,
                          const Rgb& emission = {}, bool double_sided = false);

/// Rectangle with corner p and edges a, b; its front is the side of cross(a, b).
Id<Instance> add_quad(Scene& scene, const std::string& name, Id<Material> material, const Vec3& p,
                      const Vec3& a, const Vec3& b);

/// The six walls of an axis-aligned box as one mesh, fronts facing in (a room) or out (a solid).
Id<Instance> add_box(Scene& scene, const std::string& name, Id<Material> material, const Vec3& lo,
                     const Vec3& hi, bool inward);

/// A sphere of 2 n^2 quads with smooth normals, front facing in or out.
Id<Instance> add_sphere(Scene& scene, const std::string& name, Id<Material> material, const Vec3& center,
                        float radius, int n, bool inward);

/// A flat n-gon about `center`, its front along `normal`; its area equals that of the disk.
Id<Instance> add_disk(Scene& scene, const std::string& name, Id<Material> material, const Vec3& center,
                      const Vec3& normal, float radius, int n);

/// A sky, the same everywhere. @param radiance  cd/m2
void add_sky(Scene& scene, const Rgb& radiance, Id<LightGroup> group = {});

}  // namespace sconce
