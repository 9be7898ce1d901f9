// SPDX-License-Identifier: Apache-2.0
// Objects of a scene that are put elsewhere and turned: all instances of one name are one object.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/receiver.h"
#include "scene/world.h"

namespace sconce {

/// How an object stands otherwise than where it was read.
struct ObjectMove {
  Vec3 by{0};      ///< how far its middle is from there, m
  float turn = 0;  ///< about the vertical through its middle, degrees, counter-clockwise from above

  bool operator==(const ObjectMove&) const = default;
};
/// By name.
using ObjectMoves = std::map<std::string, ObjectMove>;

/// What that does to points and directions: turned, then shifted. Of what is not turned the same bits as a
/// sum.
struct Placement {
  Mat3 turn{1.0f};
  Vec3 shift{0};

  bool operator==(const Placement&) const = default;
  Vec3 direction(const Vec3& v) const { return turn * v; }
  Vec3 point(const Vec3& p) const { return turn * p + shift; }
  SurfacePoint there(SurfacePoint at) const;
  /// The way back.
  SurfacePoint home(SurfacePoint at) const;
};

/// Names of objects, sorted. What bears no name stays where it is.
std::vector<std::string> object_names(const Scene& scene);
/// Around an object; empty where there is none of that name.
Bounds object_bounds(const Scene& scene, const World& world, const std::string& name);

/// Knows where all objects were when it was made.
class ObjectPlaces {
 public:
  ObjectPlaces(const Scene& scene, const World& world);
  /// Of each instance.
  std::vector<Placement> placements(const Scene& scene, const ObjectMoves& moves) const;
  /// Puts all objects there, in both; those that are not named go home. The same bits whatever was before.
  /// @pre the same scene and world, otherwise unchanged
  void place(const ObjectMoves& moves, Scene& scene, World& world) const;

 private:
  std::vector<Mat4> transforms_;           ///< per instance
  std::map<std::string, Vec3> middles_;    ///< per object
  std::vector<Vec3> positions_, normals_;  ///< per vertex of the World
  std::vector<glm::vec4> tangents_;        ///< per vertex, or none
  std::vector<Vec3> face_normals_;         ///< per triangle
};

}  // namespace sconce
