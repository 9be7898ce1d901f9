// SPDX-License-Identifier: Apache-2.0
// Objects of a scene that are put elsewhere: all instances of one name are one object.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/world.h"

namespace sconce {

/// How far objects are from where they were read, m, by name.
using ObjectMoves = std::map<std::string, Vec3>;

/// Names of objects, sorted. What bears no name stays where it is.
std::vector<std::string> object_names(const Scene& scene);
/// Around an object; empty where there is none of that name.
Bounds object_bounds(const Scene& scene, const World& world, const std::string& name);

/// Knows where all objects were when it was made.
class ObjectPlaces {
 public:
  ObjectPlaces(const Scene& scene, const World& world);
  /// Puts all objects there, in both; those that are not named go home. The same bits whatever was before.
  /// @pre the same scene and world, otherwise unchanged
  void place(const ObjectMoves& moves, Scene& scene, World& world) const;

 private:
  std::vector<Mat4> transforms_;  ///< per instance
  std::vector<Vec3> positions_;   ///< per vertex of the World
};

}  // namespace sconce
