// SPDX-License-Identifier: Apache-2.0
// Shapes as triangles, all closed towards the side that is seen, fronts outward.
#pragma once

#include <functional>
#include <vector>

#include "mesh_builder.h"

namespace sconce::demo {

/// Sides of a box, to be left open where it stands against something.
enum Side : unsigned {
  kLeft = 1,
  kRight = 2,
  kBottom = 4,
  kTop = 8,
  kBack = 16,
  kFront = 32
};  // -x +x -y +y -z +z

/// Axis-aligned box with chamfered, smoothly shaded edges.
void add_box(MeshBuilder& out, Vec3 lo, Vec3 hi, float bevel, unsigned open = 0);

/// One flat rectangle: from `origin` along `u` and `v`, facing u x v. Texture coordinates are metres from the
/// origin.
void add_rectangle(MeshBuilder& out, Vec3 origin, Vec3 u, Vec3 v);

/// A wall cut by the lines `us` and `vs` (metres from the origin along the unit vectors u and v), without the
/// cells that `skip(column, row)` names; faces u x v.
void add_wall(MeshBuilder& out, Vec3 origin, Vec3 u, Vec3 v, const std::vector<float>& us,
              const std::vector<float>& vs, const std::function<bool(std::size_t, std::size_t)>& skip = {});

/// Catmull-Rom curve through the points, `steps` pieces between neighbours.
template <class V>
std::vector<V> smooth_curve(const std::vector<V>& points, int steps);

/// (radius, height) pairs turned round the y axis; bottom to top on the outside faces outward.
void add_lathe(MeshBuilder& out, const std::vector<Vec2>& profile, int segments, float crease_degrees);

/// Closed rings of equally many points joined into a skin; counter-clockwise seen from where they lead to
/// faces outward.
void add_loft(MeshBuilder& out, const std::vector<std::vector<Vec3>>& rings, float crease_degrees);

/// Round tube along a path, flat ends.
void add_tube(MeshBuilder& out, const std::vector<Vec3>& path, float radius, int segments,
              bool cap_start = true, bool cap_end = true);

/// Closed outline (counter-clockwise in x, y) drawn from z = 0 to `depth`, front face with a chamfer; no
/// back.
void add_extrusion(MeshBuilder& out, const std::vector<Vec2>& outline, float depth, float bevel);

/// A grid of nu x nv quads; u x v faces front.
void add_sheet(MeshBuilder& out, int nu, int nv, const std::function<Vec3(float u, float v)>& at, Vec2 size,
               float crease_degrees = 60);

/// Circle in the plane y = 0, facing up.
void add_disk(MeshBuilder& out, float radius, int segments);

Mat4 move(Vec3 by);
Mat4 scale(Vec3 by);
/// Right-handed turn about an axis.
Mat4 turn(float degrees, Vec3 axis);

}  // namespace sconce::demo
